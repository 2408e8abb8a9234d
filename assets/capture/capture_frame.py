"""Shadow maps of a captured frame: candidates, passes, light matrices, camera, scene."""
import hashlib

import numpy as np

import capture_bundle as bundle
import capture_fit as fit
import capture_gate as gate
from capture_reading import REVERSED_FUNCTIONS, CaptureError, texture_kind

# Residual of x, y, w beyond which a draw is skinned or otherwise deformed.
SKINNED_RESIDUAL = 1e-4
MAX_MAPS = 16
MOST_NORMAL_ERROR = 0.3  # of 1 - cosine between normals and triangles, in the mean


class Pass:
    """Draws into one region of one slice of a map."""

    def __init__(self, texture, events):
        self.texture = texture
        self.events = events
        self.slice = 0
        self.viewport = (0, 0, 1, 1)
        self.state = None
        self.draws = []
        self.matrix = None      # clip_from_world
        self.method = ""
        self.places = None      # constants whose product clip_from_world and the world matrices are
        self.agreement = None   # of the matrix from two draws
        self.unread = 0


class Candidate:
    def __init__(self, texture, kind, passes, readers):
        self.texture, self.kind, self.passes, self.readers = texture, kind, passes, readers


# Candidates


def split_pass(capture, texture, kind, events):
    """Splits draws between two clears where slice or viewport change."""

    def place(event):
        capture.go(event)
        state, slice_ = capture.state(capture.control.GetPipelineState())
        if kind == "colour":
            slice_ = capture.colour_slice(texture)
        return state, slice_

    groups = []

    def same(a, b):
        return a[1] == b[1] and a[0].viewport == b[0].viewport

    known = {}

    def at(i):
        if i not in known:
            known[i] = place(events[i])
        return known[i]

    def divide(first, last):
        if same(at(first), at(last)):
            groups.append((first, last))
            return
        if last - first == 1:
            groups.append((first, first))
            groups.append((last, last))
            return
        middle = (first + last) // 2
        divide(first, middle)
        divide(middle + 1, last)

    divide(0, len(events) - 1)
    result = []
    for first, last in groups:
        state, slice_ = at(first)
        if result and result[-1].slice == slice_ and result[-1].viewport == state.viewport:
            result[-1].events += events[first:last + 1]
            continue
        part = Pass(texture, events[first:last + 1])
        part.slice, part.viewport, part.state = slice_, state.viewport, state
        result.append(part)
    return result


def find_candidates(capture, say):
    """Returns all textures that draws fill, or that an earlier frame filled, and that later draws read as a map."""
    result = []
    order = sorted(capture.textures)
    for texture in order:
        info = capture.textures[texture]
        kind = texture_kind(info.format)
        if kind is None or info.width < 16 or info.height < 16 or info.msSamp > 1:
            continue
        drawn, read, clears, copied = [], [], [], False
        for use in capture.usage(texture):
            name = use.usage.name
            if name in ("DepthStencilTarget", "ColorTarget"):
                if capture.is_draw(use.eventId):
                    drawn.append(use.eventId)
            elif name == "Clear":
                clears.append(use.eventId)
            elif name == "CopyDst" or name == "ResolveDst":
                copied = True
            elif name == "PS_Resource" and capture.is_draw(use.eventId):
                read.append(use.eventId)
        drawn = sorted(set(drawn))
        read = sorted(set(read) - set(drawn))
        if not read:
            continue
        target = capture.by_event[read[0]]
        outputs = {int(o) for o in target.outputs} | {int(target.depthOut)}
        sizes = {(capture.textures[o].width, capture.textures[o].height) for o in outputs if o in capture.textures}
        scene_size = (info.width, info.height) in sizes
        if not drawn:
            # A map that an earlier frame drew: depths that geometry reads with a depth target of its own.
            if copied or scene_size or not int(target.depthOut) or info.mips > 1:
                continue
            if kind == "colour" and info.format.compCount > 2:
                continue
            result.append(Candidate(texture, kind, [], read))
            continue
        if kind == "colour" and (scene_size or info.format.compCount == 4 and info.arraysize == 1
                                 and info.width != info.height):
            continue
        depth_targets = {int(capture.by_event[e].depthOut) for e in drawn}
        if kind == "colour" and depth_targets == {0}:
            continue  # a filter over pictures, not casters
        chunks, current = [], []
        bounds = sorted(clears)
        for event in drawn:
            if current and any(current[-1] < c < event for c in bounds):
                chunks.append(current)
                current = []
            current.append(event)
        chunks.append(current)
        passes = []
        for chunk in chunks:
            passes += split_pass(capture, texture, kind, chunk)
        # Later contents of a region replace earlier ones.
        last = {}
        for part in passes:
            last[(part.slice, part.viewport)] = part
        passes = [p for p in passes if last[(p.slice, p.viewport)] is p]
        if kind == "depth" and scene_size and len(passes) == 1 and is_camera_depth(capture, passes[0]):
            continue
        result.append(Candidate(texture, kind, passes, read))
    # Depth that is read only beside a colour map of the same casters is that map's own depth buffer.
    return result


def is_camera_depth(capture, part):
    """Returns whether draws of a depth pass write a picture, too: the camera's own depth buffer."""
    return any(int(o) for e in part.events[:8] for o in capture.by_event[e].outputs)


# Matrices


def prepare(draw):
    """Finds the position attribute of a draw. Returns false where it has none."""
    if not draw.clips:
        return False
    best = fit.position_attribute(draw)
    draw.skinned = best is None or best[0] > SKINNED_RESIDUAL
    if best is None:
        draw.position, draw.points = None, None
        draw.geometry = draw.geometry + (draw.event,)
        return True
    score, draw.position, draw.mvp, draw.error, draw.rank = best
    draw.values = fit.homogeneous(draw.attributes[draw.position])
    draw.points = draw.values[draw.indices]
    draw.geometry = geometry_key(draw)
    draw.mvps = [draw.mvp]
    for clip in draw.clips[1:]:
        draw.mvps.append(fit.fit_matrix(draw.points, clip)[0])
    return True


def geometry_key(draw):
    """Returns a key of a mesh. Passes may draw the triangles of one mesh in different orders."""
    shape = np.unique(draw.points.astype("<f4") + np.float32(0), axis=0).tobytes()
    return len(draw.points), hashlib.sha1(shape).hexdigest()


def read_pass(capture, part, report):
    for event in part.events:
        report()
        draw = capture.draw(event)
        if draw is None or not prepare(draw):
            part.unread += 1
            continue
        part.draws.append(draw)


def probes_of(draws):
    """Returns rigid draws with points of rank 4, the best conditioned first."""
    rigid = [d for d in draws if not d.skinned and d.rank == 4]
    return sorted(rigid, key=lambda d: max(d.error[0], d.error[1], d.error[3]))


def projection_by_products(draws):
    """Searches constants for clip_from_world. Returns (matrix, places) or None."""
    probes = probes_of(draws)
    if not probes:
        return None
    chosen, seen = [], []
    for draw in probes:
        scale = np.abs(draw.mvp).max()
        if all(np.abs(draw.mvp - other).max() > 1e-3 * scale for other in seen):
            chosen.append(draw)
            seen.append(draw.mvp)
        if len(chosen) == 8:
            break
    # A probe with instances may need more factors than are searched: others follow.
    for first in chosen[:5]:
        found = projection_of_probe(first, chosen)
        if found is not None:
            return found
    return None


def factors_at(draw, places):
    """Returns the product of a draw's constants at all places but the last, and the last one. None, None: one lacks."""
    factors = [fit.window_matrix(all_constants(draw), place) for place in places]
    if any(f is None for f in factors):
        return None, None
    left = np.eye(4)
    for factor in factors[:-1]:
        left = left @ factor
    return left, factors[-1]


def projection_of_probe(first, chosen):
    """Searches products of constants that explain one probe and, with the same clip_from_world, others."""
    best = None
    for error, places in fit.products(first.points, first.clips[0], all_constants(first))[:300]:
        lefts, explained = None, 0
        for draw in chosen:
            left, last = factors_at(draw, places)
            if left is None:
                continue
            whole = left @ last
            if len(places) == 1:
                left = whole
            if lefts is None:
                lefts = left
            if not np.allclose(left, lefts, rtol=1e-6, atol=1e-6 * np.abs(lefts).max()):
                continue
            points, clip = fit.sample_points(draw.points, draw.clips[0])
            if fit.scores(whole[None], points, clip)[0] < fit.MATRIX_RESIDUAL:
                explained += 1
        if len(chosen) > 1 and explained < 2:
            continue
        if len(places) == 1 and explained < len(chosen):
            continue
        # Of products that agree in x, y and w the one whose depth agrees is meant.
        _, last = factors_at(first, places)
        row = (lefts @ last if len(places) > 1 else lefts)[2]
        depth_error = float(np.median(np.abs(first.points @ row - first.clips[0][:, 2])))
        rank = (explained, -len(places) if len(places) > 1 else -2.5, -round(depth_error, 3), -error)
        if best is None or rank > best[0]:
            best = (rank, lefts, places)
    return (best[1], best[2]) if best else None


def all_constants(draw, instance=0):
    """Returns the constants of a draw and of one of its instances."""
    if instance < len(draw.instance_constants):
        return draw.constants + draw.instance_constants[instance]
    return draw.constants


def world_from_recipe(draw, places, instance=0):
    if len(places) == 1:
        return np.eye(4)
    return fit.window_matrix(all_constants(draw, instance), places[-1])


def set_worlds(part, places):
    """Gives each rigid draw its world matrices: from constants where they explain it, else from the fit."""
    inverse = np.linalg.inv(part.matrix)
    for draw in part.draws:
        draw.worlds = []
        if draw.skinned:
            continue
        for i, clip in enumerate(draw.clips):
            world = None
            if places is not None:
                world = world_from_recipe(draw, places, i)
            if world is not None:
                points, sample = fit.sample_points(draw.points, clip)
                if fit.scores((part.matrix @ world)[None], points, sample)[0] > 5 * fit.MATRIX_RESIDUAL:
                    world = None
            if world is None:
                world = affine_world(part.matrix, inverse, draw, i)
            draw.worlds.append(world)


def affine_world(matrix, inverse, draw, instance):
    """Fits the affine matrix that takes the inputs to the world, or returns None for flat meshes."""
    if draw.rank < 4:
        return None
    world = inverse @ draw.mvps[instance]
    bottom = world[3] / (world[3, 3] or 1)
    extent = np.abs(draw.points[:, :3]).max()
    if np.abs(bottom[:3]).max() * max(extent, 1e-9) > 1e-3:
        return None
    world = world / world[3, 3]
    world[3] = [0, 0, 0, 1]
    return world


def depth_row(part, places):
    """Takes the z row from the fit where the named product has another one; compares two draws."""
    candidates = []
    for draw in probes_of(part.draws):
        world = world_from_recipe(draw, places)
        if world is None or abs(np.linalg.det(world)) < 1e-18:
            continue
        whole = part.matrix @ world
        points, clip = fit.sample_points(draw.points, draw.clips[0])
        if fit.scores(whole[None], points, clip)[0] > 5 * fit.MATRIX_RESIDUAL:
            continue
        z = draw.points @ whole[2]
        w = np.maximum(np.abs(draw.clips[0][:, 3]), 1e-12)
        off = np.abs(z - draw.clips[0][:, 2]) / w
        candidates.append((draw, np.linalg.inv(world), np.median(off)))
        if len(candidates) == 12:
            break
    if not candidates:
        return
    shift = np.median([c[2] for c in candidates])
    rows = [c[0].mvp @ c[1] for c in candidates]
    if shift > 0.02:
        # Points of all probes together fix the row better than one draw does.
        points = np.concatenate([c[0].points @ np.linalg.inv(c[1]).T for c in candidates])
        depths = np.concatenate([c[0].clips[0][:, 2] for c in candidates])
        part.matrix = part.matrix.copy()
        part.matrix[2] = np.linalg.lstsq(points, depths, rcond=1e-12)[0]
        part.method += ", depth row fitted"
    part.depth_shift = float(shift)
    compare_rows(part, [(c[0], np.linalg.inv(c[1])) for c in candidates])


def compare_rows(part, pairs):
    """Compares clip_from_world with what two draws of different world matrices give by themselves."""
    for i, (draw, world) in enumerate(pairs):
        for other, other_world in pairs[i + 1:]:
            if np.abs(world - other_world).max() < 1e-3 * np.abs(world).max():
                continue
            # Both matrices are compared by what they make of the points of the two draws.
            a = draw.mvp @ np.linalg.inv(world)
            b = other.mvp @ np.linalg.inv(other_world)
            points = np.concatenate([draw.points @ world.T, other.points @ other_world.T])
            one, two = points @ a.T, points @ b.T
            rows = [0, 1, 3]
            part.agreement = float((np.abs(one - two).max(0) / np.abs(one).max(0))[rows].max())
            return


def projection_by_pairs(part, known):
    """Finds clip_from_world from draws whose geometry and world matrix are known. @param known {geometry: [world]}"""
    best = None
    for draw in probes_of(part.draws)[:12]:
        for world in known.get(draw.geometry, [])[:16]:
            if world is None or abs(np.linalg.det(world)) < 1e-18:
                continue
            matrix = draw.mvp @ np.linalg.inv(world)
            count = 0
            for other in part.draws:
                if other.skinned or other.rank < 4:
                    continue
                for w in known.get(other.geometry, [])[:16]:
                    if w is None:
                        continue
                    points, clip = fit.sample_points(other.points, other.clips[0])
                    if fit.scores((matrix @ w)[None], points, clip)[0] < 1e-3:
                        count += 1
                        break
            if best is None or count > best[0]:
                best = (count, matrix)
    if best is None or best[0] < 1:
        return None
    return best[1]


def projection_by_recipe(draws, places):
    """Finds clip_from_world by the constants that hold it in another pass. Returns the matrix or None."""
    if len(places) < 2:
        return None
    for draw in probes_of(draws):
        left, last = factors_at(draw, places)
        if left is None:
            continue
        _, instanced = fit.windows(draw.instance_constants[0] if draw.instance_constants else [])
        worlds = [last] + [last @ matrix for matrix in instanced[:16]]
        points, clip = fit.sample_points(draw.points, draw.clips[0])
        if fit.scores(np.array([left @ world for world in worlds]), points, clip).min() < fit.MATRIX_RESIDUAL:
            return left
    return None


def known_worlds(passes):
    known = {}
    for part in passes:
        if part.matrix is None:
            continue
        for draw in part.draws:
            if not draw.skinned:
                known.setdefault(draw.geometry, []).extend(w for w in draw.worlds if w is not None)
    return known


def find_matrices(passes, notes, align=True):
    """Finds clip_from_world of all passes, in one world. @param align false: passes hold a few draws only"""
    for part in passes:
        found = projection_by_products(part.draws)
        if found is None:
            continue
        part.matrix, part.places = found
        part.method = "product of constants"
        depth_row(part, part.places)
        set_worlds(part, part.places)
    matrices_by_places(passes)
    recipes = [p.places for p in passes if p.matrix is not None]
    for part in passes:
        for places in recipes:
            if part.matrix is not None:
                break
            matrix = projection_by_recipe(part.draws, places)
            if matrix is not None:
                part.matrix, part.places, part.method = matrix, places, "product of constants"
                depth_row(part, places)
                set_worlds(part, places)
    if all(p.matrix is None for p in passes):
        for part in passes:
            probes = probes_of(part.draws)
            if not probes:
                continue
            chosen = least_warped(probes)
            part.matrix, part.places = chosen.mvp, None
            part.method = "object space of draw %d" % chosen.event
            set_worlds(part, None)
            notes.append("No constant of the capture holds the world matrix. The world is the object space of draw "
                         "%d, so lengths are in its unit." % chosen.event)
            break
    for _ in range(2):
        known = known_worlds(passes)
        for part in passes:
            if part.matrix is not None or not part.draws:
                continue
            matrix = projection_by_pairs(part, known)
            if matrix is None:
                continue
            part.matrix, part.places, part.method = matrix, None, "geometry shared with another pass"
            set_worlds(part, None)
    if align:
        align_worlds(passes, notes)


def matrices_by_places(passes):
    """Finds clip_from_world of passes with flat meshes alone, by the places where other passes have theirs."""
    for part in passes:
        if part.matrix is not None:
            continue
        rigid = [d for d in part.draws if not d.skinned]
        for other in passes:
            places = other.places if other.matrix is not None and other.method.startswith("product") else None
            if places is None or len(places) < 2 or not rigid:
                continue
            shaders = {d.vertex_shader for d in other.draws}
            lefts = []
            for draw in rigid:
                left, last = factors_at(draw, places)
                if draw.vertex_shader not in shaders or left is None:
                    break
                points, clip = fit.sample_points(draw.points, draw.clips[0])
                if fit.scores((left @ last)[None], points, clip)[0] > fit.MATRIX_RESIDUAL:
                    break
                lefts.append(left)
            if len(lefts) < len(rigid) or not all(np.array_equal(left, lefts[0]) for left in lefts):
                continue
            part.matrix, part.places, part.method = lefts[0], places, "product of constants, as in another pass"
            set_worlds(part, places)
            break


def least_warped(probes):
    """Returns the probe in whose object space most others are turned, moved and scaled alone."""
    def votes(probe):
        inverse, count = np.linalg.inv(probe.mvp), 0
        for other in probes[:32]:
            world = affine_world(probe.mvp, inverse, other, 0)
            if world is None:
                continue
            square = world[:3, :3] @ world[:3, :3].T
            scale = np.trace(square) / 3
            count += bool(np.abs(square - scale * np.eye(3)).max() < 1e-2 * scale)
        return count
    return max(probes[:32], key=votes)


def align_worlds(passes, notes):
    """Brings passes whose constants speak of different worlds (another origin) into that of the last one."""
    usable = [p for p in passes if p.matrix is not None]
    if len(usable) < 2 or any(p.method.startswith("object space") for p in usable):
        return
    base = usable[-1]
    known = known_worlds([base])
    # Passes that place one mesh by the very same matrix are in one world.
    groups = []
    for part in usable:
        keys = {(d.geometry, w.tobytes()) for d in part.draws if not d.skinned for w in d.worlds if w is not None}
        shared = [g for g in groups if g[1] & keys]
        groups = [g for g in groups if not g[1] & keys]
        groups.append(([p for g in shared for p in g[0]] + [part], keys.union(*[g[1] for g in shared])))
    for parts, _ in groups:
        if base in parts:
            continue
        moves = [m for m in (move_between(part, known) for part in parts) if m is not None]
        if not moves:
            continue
        count, move = max(moves, key=lambda m: m[0])
        if np.allclose(move, np.eye(4), atol=1e-4):
            continue
        if np.abs(move[:3, :3] - np.eye(3)).max() < 1e-4:
            shift = move[:3, 3]
            move = np.eye(4)
            move[:3, 3] = shift
        for part in parts:
            part.matrix = part.matrix @ np.linalg.inv(move)
            for draw in part.draws:
                draw.worlds = [None if w is None else move @ w for w in draw.worlds]
        note = "Passes of the capture have worlds of different origins; all are brought into one."
        if note not in notes:
            notes.append(note)


def move_between(part, known):
    """Returns (draws that agree, matrix) of the move from a pass's world to another one, or None.

    @param known {geometry: [world]} of the other world
    """
    best = None
    # Meshes that are drawn once come first: others pair by chance.
    own = known_worlds([part])
    shared = sorted(set(own) & set(known), key=lambda g: (len(own[g]) * len(known[g]), g))
    pairs = [(w, v) for g in shared for w in own[g][:32] for v in known[g][:8]][:400]
    tried = []
    for world, other in [(np.eye(4), np.eye(4))] * bool(pairs) + pairs:
        if abs(np.linalg.det(world)) < 1e-18 or len(tried) > 24:
            continue
        move = other @ np.linalg.inv(world)
        if any(np.allclose(move, t, atol=1e-4 * np.abs(t).max()) for t in tried):
            continue
        tried.append(move)
        moved = np.array([move @ w for w, _ in pairs])
        size = 1e-3 * (np.abs(np.array([v for _, v in pairs])).max((1, 2)) + 1e-9)
        count = int((np.abs(moved - np.array([v for _, v in pairs])).max((1, 2)) < size).sum())
        if best is None or count > best[0]:
            best = (count, move)
    # One mesh in several places gives moves by chance.
    return None if best is None or best[0] < 2 else best


def normalise_depth_range(matrix, state):
    """Returns the matrix whose depth range is the whole one."""
    low, high = state.depth_range
    if (low, high) == (0.0, 1.0):
        return matrix
    result = matrix.copy()
    if state.negative_one:
        result[2] = (high - low) * matrix[2] + (high + low - 1) * matrix[3]
    else:
        result[2] = (high - low) * matrix[2] + low * matrix[3]
    return result


# Output


def world_positions(part, draw, instance):
    """Returns world positions of the corners of one instance."""
    if instance < len(draw.posed):
        return draw.posed[instance]
    world = draw.worlds[instance] if instance < len(draw.worlds) else None
    if world is not None:
        return (draw.points @ world.T)[:, :3]
    points = draw.clips[instance] @ np.linalg.inv(part.matrix).T
    return points[:, :3] / points[:, 3:4]


def smooth_normals(points):
    """Returns unit normals of the corners of triangles, shared by corners of one place."""
    corners = points.reshape(-1, 3, 3)
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    _, place = np.unique(np.round(points / (np.ptp(points) + 1e-12), 6), axis=0, return_inverse=True)
    normal = np.zeros((place.max() + 1, 3))
    np.add.at(normal, place, np.repeat(face, 3, axis=0))
    return normal[place] / np.maximum(np.linalg.norm(normal[place], axis=1, keepdims=True), 1e-30)


def vertex_normals(draw):
    """Returns the unit normals of a draw's vertices, in the space of its positions, or None.

    They are the input of three numbers that has length 1 and agrees best with the triangles.
    """
    corners = draw.values[draw.indices][:, :3].reshape(-1, 3, 3)
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(face, axis=1)
    seen = length > 1e-6 * max(length.max(initial=0), 1e-30)
    if not seen.any():
        return None
    face = np.repeat(face[seen] / length[seen, None], 3, axis=0)
    best, most = None, MOST_NORMAL_ERROR
    for name, values in draw.attributes.items():
        if name == draw.position or values.shape[1] < 3:
            continue
        normals = values[:, :3]
        size = np.linalg.norm(normals, axis=1)
        if not np.isfinite(size).all() or (np.abs(size - 1) > 0.05).mean() > 0.01:
            continue
        normals = np.where(size[:, None] > 0.5, normals / np.maximum(size, 1e-30)[:, None], [0.0, 1.0, 0.0])
        # Engines differ in the winding of front faces.
        cosine = (normals[np.asarray(draw.indices).reshape(-1, 3)[seen].ravel()] * face).sum(1).mean()
        if 1 - abs(cosine) < most:
            best, most = normals, 1 - abs(cosine)
    return best


def smooth_cosines(part, points):
    """Returns |n.l| of the corners of triangles, with normals that are shared by corners of one place."""
    kind = fit.light_of(part.matrix, part.state.function in REVERSED_FUNCTIONS, part.state.negative_one)
    normal = smooth_normals(points)
    towards = -kind[1][None] if kind[0] == "directional" else kind[1][None] - points
    towards = towards / np.linalg.norm(towards, axis=1, keepdims=True)
    return np.abs((normal * towards).sum(1))


def unmoved_positions(part, others, bias):
    """Sets positions of skinned draws where the casters' shader has moved the depths from which they follow.

    @param others passes that may have drawn the same skins elsewhere; without one the measured bias is taken off
    """
    drawn = {}
    for other in others:
        for draw in other.draws if other.matrix is not None else []:
            if draw.skinned and len(draw.clips) == 1:
                drawn.setdefault(draw.geometry, []).append(world_positions(other, draw, 0))
    scale = 2 if part.state.negative_one else 1
    for draw in part.draws:
        if not draw.skinned:
            continue
        draw.posed = []
        for i, clip in enumerate(draw.clips):
            for points in drawn.get(draw.geometry, []):
                seen = np.hstack([points, np.ones((len(points), 1))]) @ part.matrix.T
                if np.abs(seen[:, :2] / seen[:, 3:] - clip[:, :2] / clip[:, 3:]).max() < 2e-3:
                    draw.posed.append(points)
                    break
            else:
                inverse = np.linalg.inv(part.matrix).T
                points = clip @ inverse
                cosine = np.maximum(smooth_cosines(part, points[:, :3] / points[:, 3:]), 0.05)
                shift = bias["constant"] + bias["one_minus_cosine"] * (1 - cosine) + \
                    bias["tangent"] * np.sqrt(1 - np.minimum(cosine, 1) ** 2) / cosine
                still = clip.copy()
                still[:, 2] -= scale * shift * clip[:, 3]
                points = still @ inverse
                draw.posed.append(points[:, :3] / points[:, 3:])


def corner_uv(draw, name, flip):
    uv = draw.attributes[name][:, :2]
    uv = uv[draw.indices].reshape(-1, 3, 2)
    return np.stack([uv[:, :, 0], 1 - uv[:, :, 1]], 2) if flip else uv


def sample_texture(image, uv, channel):
    """Samples one channel by linear interpolation, repeated."""
    height, width = image.shape[:2]
    x, y = uv[:, 0] * width - 0.5, uv[:, 1] * height - 0.5
    x0, y0 = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    fx, fy = x - x0, y - y0
    plane = image[:, :, channel]

    def at(i, j):
        return plane[j % height, i % width]

    return (at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx) * (1 - fy) + \
        (at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx) * fy


class Mask:
    """Texture, texture coordinates and threshold that drop texels of a draw."""

    def __init__(self, texture, image, channel, uv, flip, cutoff=0.5):
        self.texture, self.image, self.channel, self.uv, self.flip, self.cutoff = \
            texture, image, channel, uv, flip, cutoff

    def keep(self, draw, w):
        corners = corner_uv(draw, self.uv, self.flip)
        corners = np.concatenate([corners] * (len(w) // (3 * len(corners))))

        def test(triangles, share):
            weights = share / w.reshape(-1, 3)[triangles]
            weights = weights / weights.sum(1, keepdims=True)
            uv = (corners[triangles] * weights[:, :, None]).sum(1)
            return sample_texture(self.image, uv, self.channel) >= self.cutoff

        return test


def mask_options(capture, draw):
    """Returns all masks that a draw may have."""
    result = []
    names = [n for n, v in draw.attributes.items() if n != draw.position and 2 <= v.shape[1] <= 4]
    for texture in draw.textures:
        info = capture.textures.get(texture)
        if info is None or texture_kind(info.format) == "depth" or info.width < 2 or info.height < 2:
            continue
        if info.arraysize > 1 or info.depth > 1 or info.format.compByteWidth != 1:
            continue
        try:
            image = capture.texels(texture)
        except CaptureError:
            continue
        if image is None:
            continue
        channel = image.shape[2] - 1 if image.shape[2] in (2, 4) else 0
        if np.ptp(image[:, :, channel]) < 0.05:
            continue
        for name in names:
            for flip in (False, True):
                result.append(Mask(texture, image, channel, name, flip))
    return result


def draw_clip(part, draw, instance):
    """Returns (triangle, corner, 4) clip positions by the matrix of the pass."""
    # Vertex shaders compute with 32 bits.
    points = world_positions(part, draw, instance).astype(np.float32)
    clip = np.hstack([points, np.ones((len(points), 1), np.float32)]) @ part.matrix.T.astype(np.float32)
    return clip.astype(float).reshape(-1, 3, 4)


def draw_clips(part, draw):
    """Returns the clip positions of all instances of a draw, one instance after the other."""
    return np.concatenate([draw_clip(part, draw, i) for i in range(len(draw.clips))])


def raster_draw(raster, part, draw, tag, step, mask=None):
    """Draws all instances of a draw."""
    clip = draw_clips(part, draw)
    raster.draw(clip, draw.state, tag, step, mask.keep(draw, clip[:, :, 3].ravel()) if mask else None)


def choose_masks(capture, part, captured, covered, raster, step, known, apart=None):
    """Finds masks of draws that may drop texels by comparing with the captured map.

    @param captured depths; None: coverage alone tells @param raster draws without mask
    @param known masks by pixel shader and textures, of earlier maps @param apart see mask_truth()
    """
    groups = {}
    for draw in part.draws:
        if draw.discards:
            groups.setdefault((draw.pixel_shader, tuple(draw.textures)), []).append(draw)
    for key, draws in groups.items():
        solid = gate.Raster(raster.width, raster.height, raster.reversed)
        solid.shift = raster.shift
        for draw in draws:
            raster_draw(solid, part, draw, 0, step)
        region, truth = mask_truth(solid, raster, captured, covered, step, apart)
        best = (float(np.mean(~truth)) if len(truth) else 0.0, None)  # solid
        options = mask_options(capture, draws[0])
        # A mask of another pass, which may have another shader.
        options = [m for m in known.values() if m.texture in draws[0].textures and
                   m.uv in draws[0].attributes] + options
        if not options:
            continue
        if len(truth) < 16:
            for draw in draws:
                draw.mask_unknown = True
            continue
        for option in options:
            trial = masked_coverage(part, draws, option, raster, step)
            wrong = float(np.mean(trial[region] != truth))
            if wrong < best[0]:
                best = (wrong, option)
            if option in known.values() and wrong < 0.02:
                break
        if best[1] is None or best[0] > 0.1:
            for draw in draws:
                draw.mask_unknown = best[0] > 0.001
            continue
        option = best[1]
        if option not in known.values():
            for cutoff in cutoffs(draws[0]):
                other = Mask(option.texture, option.image, option.channel, option.uv, option.flip, cutoff)
                wrong = float(np.mean(masked_coverage(part, draws, other, raster, step)[region] != truth))
                if wrong < best[0] * 0.98:
                    best = (wrong, other)
        known[key] = best[1]
        for draw in draws:
            draw.mask, draw.mask_wrong = best[1], best[0]


def mask_truth(solid, raster, captured, covered, step, apart=None):
    """Returns texels where a masked draw may be seen, and whether it is seen there.

    @param apart least difference of depth that tells two surfaces apart
    """
    if captured is None:
        region = solid.covered() & ~raster.covered()
        return region, covered[region]
    apart = apart or 16 * (step or 2.0 ** -24)
    nearer = solid.depth - raster.depth if raster.reversed else raster.depth - solid.depth
    region = solid.covered() & (nearer > apart)
    return region, (np.abs(captured - solid.depth) < np.abs(captured - raster.depth))[region]


def cutoffs(draw):
    """Returns thresholds that a mask may have: numbers between 0 and 1 of the pixel shader's constants, and tenths."""
    result = [0.1, 0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9]
    for _, data in draw.pixel_constants:
        if len(data) <= 512:
            values = np.frombuffer(data[:len(data) // 4 * 4], "<f4")
            result += [float(v) for v in values if 0.01 < v < 0.99 and round(float(v), 6) not in result]
    return result[:40]


def masked_coverage(part, draws, option, raster, step):
    trial = gate.Raster(raster.width, raster.height, raster.reversed)
    trial.shift = raster.shift
    for draw in draws:
        if option.uv not in draw.attributes:
            continue
        raster_draw(trial, part, draw, 0, step, option)
    return trial.covered()


def viewport_part(part, image):
    x, y, w, h = (int(round(v)) for v in part.viewport)
    height, width = image.shape[:2]
    x, y = max(x, 0), max(y, 0)
    return (x, y, min(w, width - x), min(h, height - y))


def linear_depth(matrix, depth, negative_one, reversed_):
    """Returns depths along the light's axis, 0 at the near plane and 1 at the far plane."""
    z = depth * 2 - 1 if negative_one else depth
    inverse = np.linalg.inv(matrix)
    ends = [inverse @ np.array([0, 0, v, 1.0]) for v in ((-1.0 if negative_one else 0.0), 1.0)]
    ends = [e / e[3] for e in ends]
    w = [float(matrix[3] @ e) for e in ends]
    if abs(w[1] - w[0]) < 1e-6 * max(abs(w[0]), abs(w[1])):
        result = depth
    else:
        # z over w is linear in 1 over w.
        share = (z - (-1.0 if negative_one else 0.0)) / (2.0 if negative_one else 1.0)
        result = (1 / ((1 - share) / w[0] + share / w[1]) - w[0]) / (w[1] - w[0])
    return 1 - result if reversed_ and abs(w[1] - w[0]) < 1e-6 * max(abs(w[0]), abs(w[1])) else result


def half_step(values):
    """Returns the step of 16-bit floats at values."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.abs(np.spacing(values.astype(np.float16))).astype(float)


def fit_plane(points, values):
    """Fits values = plane . point without outliers. Returns the plane and the median error."""
    plane = np.linalg.lstsq(points, values, rcond=1e-12)[0]
    for _ in range(6):
        error = np.abs(points @ plane - values)
        inside = error <= 6 * np.median(error) + 1e-9
        plane = np.linalg.lstsq(points[inside], values[inside], rcond=1e-12)[0]
    error = np.abs(points @ plane - values)
    return plane, float(np.median(error)), float(np.percentile(error[error <= 6 * np.median(error) + 1e-9], 99))


def texel_meaning(part, values, depth, both, size, half=False):
    """Finds what a texel of a colour map holds. Returns (stored, extras, residual) of the smallest residual.

    @param half the map holds 16-bit floats
    """
    reversed_ = part.state.function in REVERSED_FUNCTIONS
    linear = linear_depth(part.matrix, depth, part.state.negative_one, reversed_)
    places = np.nonzero(both & np.isfinite(values) & np.isfinite(linear))[0]
    if len(places) < 64:
        return "depth", {}, None
    places = places[::max(1, len(places) // 50000)]
    values, depth, linear = values[places], depth[places], linear[places]
    options = [(float(np.median(np.abs(values - depth))), "depth", {}),
               (float(np.median(np.abs(values - linear))), "linear", {})]
    if (values > 0).mean() >= 0.99 and np.ptp(np.log(values[values > 0])) > 1:
        share = np.log(np.maximum(values, 1e-30))
        exponent = float(np.median(share / np.maximum(linear, 1e-6)))
        options.append((float(np.median(np.abs(share / exponent - linear))), "exponential", {"exponent": exponent}))
    best = min(options, key=lambda o: o[0])
    if best[0] < 1e-4:
        return best[1], best[2], best[0]
    points = texel_points(part, places, depth, size)
    kind = fit.light_of(part.matrix, reversed_, part.state.negative_one)
    if kind[0] == "local":
        distances = np.linalg.norm(points[:, :3] - kind[1], axis=1)
        scale = float(np.median(values / distances))
        # The residual is a share of the values, which may be metres.
        error = float(np.median(np.abs(values - scale * distances))) / max(float(np.median(np.abs(values))), 1e-30)
        if scale > 0 and error < 1e-3 and error < best[0]:
            if abs(scale - 1) < 1e-3:
                return "distance-metres", {}, error
            return "distance-share", {"range_m": 1 / scale}, error
    if best[0] < 1e-3:
        return best[1], best[2], best[0]
    # A distance along an axis of the engine's own is linear in the world position.
    plane, error, worst = fit_plane(points, values)
    more = {}
    if half:
        # Drivers round to the nearest 16-bit float, or cut off: values then lie half a step higher.
        other, other_error, other_worst = fit_plane(points, values + half_step(values) / 2)
        more = {"rounding": "towards zero" if other_worst < worst else "to nearest"}
        if other_worst < worst:
            plane, error = other, other_error
    if error < best[0]:
        return "linear", dict(more, plane=[float(v) for v in plane]), error
    return best[1], best[2], best[0]


def unprojected(part, places, z, size):
    """Returns world positions, (n, 4), of texels at a clip z over w, not divided by their w."""
    width, height = size
    x = (places % width + 0.5) / width * 2 - 1
    y = (places // width + 0.5) / height * 2 - 1
    clip = np.stack([x, -y if part.state.flipped else y, np.broadcast_to(z, x.shape), np.ones_like(x)], 1)
    return clip @ np.linalg.inv(part.matrix).T


def texel_points(part, places, depth, size):
    """Returns world positions, (n, 4), of texels at a depth."""
    points = unprojected(part, places, depth * 2 - 1 if part.state.negative_one else depth, size)
    return points / points[:, 3:4]


def depths_of_plane(part, values, cleared, half):
    """Returns the depths of texels that hold plane . world position. @param values, cleared (row, column) arrays"""
    height, width = values.shape
    reversed_ = part.state.function in REVERSED_FUNCTIONS
    plane = np.array(part.stored["plane"])
    middle = values + half_step(values) / 2 if half and part.stored.get("rounding") == "towards zero" else values
    middle = middle.ravel()
    start = unprojected(part, np.arange(width * height), 0.0, (width, height))
    step = np.linalg.inv(part.matrix)[:, 2]
    # plane . (start + z step) = value times the w of the same point.
    with np.errstate(divide="ignore", invalid="ignore"):
        z = (start @ plane - middle * start[:, 3]) / (middle * step[3] - plane @ step)
    depth = (z + 1) / 2 if part.state.negative_one else z
    depth = np.where((values == cleared).ravel(), 0.0 if reversed_ else 1.0, np.clip(depth, 0, 1))
    return depth.reshape(height, width)


def colour_depths(part, values, cleared, seen, raster, size, half):
    """Returns the depths of a colour map whose texels are linear in the world position, and how exact they are.

    None, None for other maps. @param seen covered texels on which no masked caster lies
    @param raster draws without mask
    """
    both = seen & raster.covered()
    _, more, error = texel_meaning(part, values, raster.plain, both, size, half)
    if error is None or "plane" not in more:
        return None, None
    part.stored = dict(more, stored="linear")
    width, height = size
    depths = depths_of_plane(part, values.reshape(height, width), cleared.reshape(height, width), half).ravel()
    off = np.abs(depths - raster.plain)[both]
    return depths, 4 * float(np.percentile(off[np.isfinite(off)], 99))


def texels_like_clear(part, values, cleared, depth, both, size, half):
    """Returns texels of a colour map for whose depth the engine stores the value of the cleared map.

    They cannot be told from texels that no caster covers. @param half the map holds 16-bit floats
    """
    stored = part.stored["stored"]
    if stored not in ("depth", "linear"):
        return np.zeros(len(values), bool)
    if "plane" in part.stored:
        expected = texel_points(part, np.arange(len(values)), depth, size) @ np.array(part.stored["plane"])
    elif stored == "linear":
        expected = linear_depth(part.matrix, depth, part.state.negative_one,
                                part.state.function in REVERSED_FUNCTIONS)
    else:
        expected = depth
    if half and "rounding" in part.stored:
        # A hundredth of a step for the error of the fit.
        step = half_step(cleared)
        low = cleared - (0 if part.stored["rounding"] == "towards zero" else step / 2)
        return (expected >= low - 0.01 * step) & (expected <= low + 1.01 * step)
    error = np.abs(expected - values)[both]
    error = error[np.isfinite(error)]
    return np.abs(expected - cleared) <= (np.percentile(error, 99) if len(error) else 0)


def gate_of(capture, part, image, depth_format, clear_image, colour, report, known):
    """Draws the casters again and compares them with the captured map. Returns numbers of the gate.

    @param clear_image texels before the first draw, of a colour map @param known masks of earlier maps
    """
    reversed_ = part.state.function in REVERSED_FUNCTIONS
    for draw in part.draws:
        draw.state.unit_steps = capture.unit_steps
    x, y, width, height = viewport_part(part, image)
    captured = image[y:y + height, x:x + width, 0].ravel()
    step = gate.step_of(depth_format)
    raster = gate.Raster(width, height, reversed_)
    skinned = sum(d.skinned for d in part.draws)
    instances = sum(len(d.clips) for d in part.draws)
    for number, draw in enumerate(part.draws):
        draw.mask, draw.mask_unknown, draw.mask_wrong = None, False, 0.0
        if draw.discards:
            continue
        raster_draw(raster, part, draw, number, step)
        report()
    if colour:
        cleared = clear_image[y:y + height, x:x + width, 0].ravel()
        is_covered = captured != cleared
    else:
        is_covered = captured != (0.0 if reversed_ else 1.0)
    masked = gate.Raster(width, height, reversed_)
    for number, draw in enumerate(part.draws):
        if draw.discards:
            raster_draw(masked, part, draw, number, step)
    solid = masked.covered()
    half = colour and capture.textures[part.texture].format.compByteWidth == 2
    if any(d.discards for d in part.draws):
        depths, apart = captured, None
        if colour:
            depths, apart = colour_depths(part, captured, cleared, is_covered & ~solid, raster, (width, height), half)
        choose_masks(capture, part, depths, is_covered, raster, step, known, apart)
    for number, draw in enumerate(part.draws):
        if draw.discards and not draw.mask_unknown:
            raster_draw(raster, part, draw, number, step, draw.mask)
    own = raster.covered()
    quantised = np.rint(raster.depth / step) * step if step else raster.depth.astype(np.float32).astype(float)
    if not colour:
        own &= quantised != (0.0 if reversed_ else 1.0)  # a depth at the clear value covers nothing
    opaque = ~solid
    missed_all, extra_all = is_covered & ~(own | solid), own & ~is_covered
    missed, extra = missed_all & opaque, extra_all & opaque
    unmasked = is_covered & opaque
    both = unmasked & own
    if not colour and capture.unit_steps == 1:
        steps = gate.unit_steps_of((captured - raster.depth)[both], part.draws[0].state.units, step)
        if steps is not None:
            capture.unit_steps = steps
            return gate_of(capture, part, image, depth_format, clear_image, colour, report, known)
    stored = {"stored": "depth"}
    part.stored = dict(stored)
    is_empty = not is_covered.any() and not (own | solid).any()
    result_of_colour = {}
    if colour:
        name, more, error = texel_meaning(part, captured, raster.plain, both, (width, height), half)
        stored = {"stored": name, "residual": error}
        stored.update(more)
        part.stored = dict(more, stored=name)
        inner = np.zeros((height, width), bool)
        inner[1:-1, 1:-1] = True
        extra &= inner.ravel()
        like_clear = texels_like_clear(part, captured, cleared, raster.plain, both, (width, height), half)
        result_of_colour["like_clear"] = int((extra & like_clear).sum())
        extra &= ~like_clear
    result = {
        "captured_texels": int(is_covered.sum()), "captured_unmasked_texels": int(unmasked.sum()),
        "masked_texels": int(solid.sum()), "missed": int(missed.sum()), "extra": int(extra.sum()),
        "missed_all": int(missed_all.sum()), "extra_all": int(extra_all.sum()),
        "mask_mismatch": max([d.mask_wrong for d in part.draws] or [0]),
        "masks_unknown": sum(d.mask_unknown for d in part.draws), "texels_hold": stored,
        "draws": len(part.draws), "instances": instances, "masked_draws": sum(d.discards for d in part.draws),
        "post_vertex_draws": skinned, "post_vertex_share": skinned / max(1, len(part.draws)),
        "unread_draws": part.unread, "matrix_agreement": part.agreement,
        "fit_residual": median_residual(part), **result_of_colour,
    }
    share = max(1, result["captured_unmasked_texels"])
    passed = result["missed"] <= 0.001 * share and result["extra"] <= 0.0001 * share and bool(both.any())
    if is_empty:
        passed = True  # a face of a cube that no caster reaches
    elif not colour:
        result["depth"] = depth = gate.compare_depths(captured, quantised, both, step)
        result["caster_bias"] = caster_bias(part, captured, raster, both)
        residual = result["fit_residual"]
        # A depth that no matrix explains, beside exact x, y and w, comes from a bias in the caster's shader.
        result["shader_bias"] = residual is not None and residual[2] > 1e-4 and max(
            residual[0], residual[1], residual[3]) < 1e-5 and result["caster_bias"] is not None
        agrees = depth.get("texels", 0) > 0 and depth["median_steps"] <= 1.001 and depth["percentile_99_steps"] <= 4.001
        if not agrees and not result["shader_bias"]:
            # The caster's shader may write a depth of its own.
            name, more, error = texel_meaning(part, captured, raster.plain, both, (width, height))
            if error is not None and error < 1e-3 and name in ("linear", "distance-metres", "distance-share") and \
                    "plane" not in more:
                result["texels_hold"] = dict(more, stored=name, residual=error)
                part.stored = dict(more, stored=name)
                result["depth"], result["caster_bias"] = {"texels": depth["texels"]}, None
                agrees = True
        # What is left after the measured bias has to be as small as depths without it are.
        explained = result["shader_bias"] and result["caster_bias"]["median_error"] <= 4 * (step or 2.0 ** -23)
        passed = passed and depth.get("texels", 0) > 0 and (explained or agrees)
    else:
        passed = passed and stored["residual"] is not None and stored["residual"] < 1e-3
    result["passed"] = bool(passed and (part.agreement is None or part.agreement <= 1e-4))
    return result


def median_residual(part):
    rigid = [d.error for d in part.draws if not d.skinned]
    return [float(v) for v in np.median(rigid, axis=0)] if rigid else None


def caster_bias(part, captured, raster, both):
    """Fits captured minus rebuilt depth, with the recorded polygon offset, to the angle between light and surface."""
    places = np.nonzero(both & np.isfinite(raster.plain))[0]
    if len(places) < 64:
        return None
    places = places[::max(1, len(places) // 60000)]
    kind = fit.light_of(part.matrix, part.state.function in REVERSED_FUNCTIONS, part.state.negative_one)
    cosines = np.full(len(places), np.nan)
    tags, owners = raster.tag[places], raster.owner[places]
    for tag in np.unique(tags):
        draw = part.draws[tag]
        if draw.skinned:
            continue  # their positions have the bias
        rows = np.nonzero(tags == tag)[0]
        corners = [world_positions(part, draw, i) for i in range(len(draw.clips))]
        corners = np.concatenate(corners).reshape(-1, 3, 3)[owners[rows]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(normal, axis=1)
        towards = -kind[1][None] if kind[0] == "directional" else kind[1][None] - corners.mean(1)
        towards = towards / np.linalg.norm(towards, axis=1, keepdims=True)
        cosines[rows] = np.abs((normal * towards).sum(1)) / np.maximum(length, 1e-30)
    good = np.isfinite(cosines)
    return gate.fit_bias((captured[places] - raster.depth[places])[good], cosines[good])


def front_sign(part, draw):
    """Returns +1 where triangles in their own order have normals on the front side, else -1."""
    kind = fit.light_of(part.matrix, part.state.function in REVERSED_FUNCTIONS, part.state.negative_one)
    clip = draw.clips[0].reshape(-1, 3, 4)
    world = world_positions(part, draw, 0).reshape(-1, 3, 3)
    ndc = clip[:, :, :2] / clip[:, :, 3:4]
    a, b = ndc[:, 1] - ndc[:, 0], ndc[:, 2] - ndc[:, 0]
    area = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    normal = np.cross(world[:, 1] - world[:, 0], world[:, 2] - world[:, 0])
    towards = -kind[1][None] if kind[0] == "directional" else kind[1][None] - world.mean(1)
    towards = np.broadcast_to(towards, normal.shape)
    facing = (normal * towards).sum(1)
    front = (area > 0) == draw.state.front_ccw
    weight = np.abs(area)
    return 1 if (np.where(front, facing, -facing) * weight > 0).mean() >= 0.5 else -1


class SceneWriter:
    """Collects nodes of casters and receivers, each once."""

    def __init__(self):
        self.scene = bundle.Scene()
        self.names = {}  # (geometry, rounded world): name
        self.post_vertex = 0
        self.drawn = {}

    def add(self, part, draw, caster):
        """Adds all instances of a draw. Returns the names of its nodes."""
        names = []
        sign = normals = None
        for i in range(len(draw.clips)):
            world = draw.worlds[i] if i < len(draw.worlds) else None
            positions = world_positions(part, draw, i)
            centre = positions.mean(0)
            extent = np.ptp(positions, axis=0)
            key = (draw.geometry, draw.skinned)
            # What a measured bias was taken off is exact to a part of that bias.
            name = self.find(key, centre, extent, 2e-2 if draw.posed else 2e-3)
            if name is None:
                if sign is None:
                    sign, normals = front_sign(part, draw), vertex_normals(draw)
                name = "draw %d" % draw.event if len(draw.clips) == 1 else "draw %d instance %d" % (draw.event, i)
                self.write(name, draw, world, positions, sign, normals)
                self.names.setdefault(key, []).append((centre, extent, name))
            names.append(name)
        return names

    def find(self, key, centre, extent, share):
        size = share * (np.abs(extent).max() + 1e-9)
        for other, other_extent, name in self.names.get(key, []):
            if np.abs(other - centre).max() < size and np.abs(other_extent - extent).max() < size:
                return name
        return None

    def write(self, name, draw, world, positions, sign, normals):
        double = draw.state.cull == "none"
        mask = getattr(draw, "mask", None)
        uv = None
        material_mask = None
        if mask is not None and mask.uv in draw.attributes:
            uv = draw.attributes[mask.uv][:, :2]
            if mask.flip:
                uv = np.stack([uv[:, 0], 1 - uv[:, 1]], 1)
            image = np.zeros(mask.image.shape[:2] + (4,), np.uint8)
            image[:, :, :3] = 200
            image[:, :, 3] = np.rint(mask.image[:, :, mask.channel] * 255)
            material_mask = ((mask.texture, mask.channel), bundle.rgba_png(image), float(mask.cutoff))
        material = self.scene.material(double, material_mask)
        triangles = np.asarray(draw.indices).reshape(-1, 3)
        if world is None or draw.rank < 4:
            # Positions after the vertex shader, and flat meshes: world space.
            flat = np.arange(len(positions)).reshape(-1, 3)
            if sign < 0:
                flat = flat[:, [0, 2, 1]]
            mesh = self.scene.mesh((name,), positions, flat, material, uv[draw.indices] if uv is not None else None,
                                   smooth_normals(positions) * sign if draw.posed else None)
            self.scene.node(name, mesh, np.eye(4))
            return
        # glTF turns the front of a mirrored node; engines do not.
        turn = sign * np.sign(np.linalg.det(world[:3, :3])) < 0
        if turn:
            triangles = triangles[:, [0, 2, 1]]
        mesh = self.scene.mesh((draw.geometry, bool(turn), mask.uv if mask else None), draw.values[:, :3], triangles,
                               material, uv, normals)
        self.scene.node(name, mesh, world)


def group_lights(maps):
    """Groups maps of one direction or of one place into lights."""
    lights = []
    for entry in maps:
        for light in lights:
            first = light[0]
            if first["kind"][0] != entry["kind"][0] or first["texture"] != entry["texture"]:
                continue
            if entry["kind"][0] == "directional":
                if np.dot(first["kind"][1], entry["kind"][1]) > 0.9999:
                    light.append(entry)
                    break
            else:
                distance = np.linalg.norm(first["kind"][1] - entry["kind"][1])
                if distance < 1e-3 * (1 + np.linalg.norm(first["kind"][1])):
                    light.append(entry)
                    break
        else:
            lights.append([entry])
    result = []
    for light in lights:
        if light[0]["kind"][0] == "local" and len(light) not in (1, 6):
            result += [[entry] for entry in light]
        else:
            result.append(light)
    return result


def describe(capture, index, candidate, part, number):
    info = capture.textures[candidate.texture]
    line = {"number": number, "texture": candidate.texture, "width": info.width, "height": info.height,
            "format": info.format.Name(), "layers": info.arraysize, "holds": candidate.kind}
    if part is None:
        line.update(draws=0, state="texels, no caster pass")
    else:
        line.update(slice=part.slice, viewport=[float(v) for v in part.viewport], draws=len(part.events),
                    first_event=part.events[0])
    return line


def run(capture, options, say):
    from capture_output import import_maps
    say(progress=0.1, label="looking for shadow maps")
    candidates = find_candidates(capture, say)
    if not candidates:
        raise CaptureError("holds no shadow map: no texture that draws fill with depth and later draws read")
    numbered = []
    for candidate in candidates:
        for part in candidate.passes or [None]:
            numbered.append((candidate, part))
    if options.list:
        for number, (candidate, part) in enumerate(numbered):
            line = describe(capture, number, candidate, part, number)
            if part is not None:
                sample = Pass(part.texture, part.events[:1] + part.events[len(part.events) // 2:][:3])
                sample.state = part.state
                read_pass(capture, sample, lambda: None)
                find_matrices([sample], [])
                probes = probes_of(sample.draws)
                if sample.matrix is not None or probes:
                    matrix = sample.matrix if sample.matrix is not None else probes[0].mvp
                    kind = fit.light_of(matrix, part.state.function in REVERSED_FUNCTIONS, part.state.negative_one)
                    line["light"] = "directional" if kind[0] == "directional" else "spot or point"
                    if sample.matrix is not None and sample.method.startswith("product"):
                        line["direction" if kind[0] == "directional" else "centre"] = [float(v) for v in kind[1]]
            say(candidate=line)
            say(progress=(number + 1) / len(numbered), label="looking at passes")
        return
    for pick in options.pick:
        if pick < 0 or pick >= len(numbered):
            raise CaptureError("has no candidate %d; --list prints them, 0 to %d" % (pick, len(numbered) - 1))
    chosen = [numbered[i] for i in options.pick] if options.pick else numbered
    import_maps(capture, chosen, options, say)
