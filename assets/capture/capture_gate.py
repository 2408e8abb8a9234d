"""Comparison of a captured map with casters drawn again by a small rasteriser."""
import numpy as np

SUBPIXELS = 256
CHUNK = 3_000_000


def clip_far_out(triangles, owners):
    """Cuts triangles that reach behind the centre of projection or far beyond the viewport."""
    x, y, w = triangles[:, :, 0], triangles[:, :, 1], triangles[:, :, 3]
    least = 1e-6 * (np.abs(w).max() if w.size else 1.0)
    planes = [np.array([0, 0, 0, 1.0]), np.array([1, 0, 0, 2.0]), np.array([-1, 0, 0, 2.0]), np.array([0, 1, 0, 2.0]),
              np.array([0, -1, 0, 2.0])]
    good = ((w > least) & (np.abs(x) < 8 * w) & (np.abs(y) < 8 * w)).all(1)
    out = np.zeros(len(triangles), bool)
    for plane in planes:
        out |= (triangles @ plane <= (least if plane[0] == plane[1] else 0)).all(1)
    whole, cut = good & ~out, np.nonzero(~good & ~out)[0]
    pieces, sources = clip_polygons(triangles[cut], planes, least)
    return np.concatenate([triangles[whole], pieces]), np.concatenate([owners[whole], owners[cut][sources]])


def clip_polygons(triangles, planes, least):
    """Cuts triangles by planes, all at once. Returns the pieces and the triangle that each is a piece of."""
    corners, counts = triangles, np.full(len(triangles), 3)
    for plane in planes:
        edge = least if plane[0] == plane[1] else 0
        size = corners.shape[1]
        places = np.arange(size)
        there = places < counts[:, None]
        following = np.where(places + 1 < counts[:, None], places + 1, 0)
        height = corners @ plane - edge
        height_next = np.take_along_axis(height, following, 1)
        crosses = there & ((height > 0) != (height_next > 0))
        share = height / np.where(crosses, height - height_next, 1)
        towards = np.take_along_axis(corners, following[:, :, None], 1) - corners
        # Each edge gives its first corner, if that is inside, and the point where it crosses the plane.
        found = np.stack([corners, corners + share[:, :, None] * towards], 2).reshape(len(corners), 2 * size, 4)
        kept = np.stack([there & (height > 0), crosses], 2).reshape(len(corners), 2 * size)
        counts = kept.sum(1)
        order = np.argsort(~kept, axis=1, kind="stable")[:, :max(3, int(counts.max(initial=0)))]
        corners = np.take_along_axis(found, order[:, :, None], 1)
    pieces, sources = [np.zeros((0, 3, 4))], [np.zeros(0, np.int64)]
    for i in range(1, corners.shape[1] - 1):
        rows = np.nonzero(counts > i + 1)[0]
        pieces.append(corners[rows][:, [0, i, i + 1]])
        sources.append(rows)
    return np.concatenate(pieces), np.concatenate(sources)


def runs(counts, limit):
    """Yields places and numbers of all things where place p has counts[p] of them, about a limit at a time."""
    ends = np.cumsum(counts)
    start = 0
    while start < len(counts):
        before = ends[start - 1] if start else 0
        end = max(start + 1, int(np.searchsorted(ends, before + limit, side="right")))
        part = counts[start:end]
        place = np.repeat(np.arange(start, end), part)
        if len(place):
            yield place, np.arange(len(place)) - np.repeat(np.cumsum(part) - part, part)
        start = end


def spans(sx, sy, t, py, x0, x1):
    """Returns the first texel and the number of texels of triangles in rows, by the exact rule of rasterisers.

    @param sx, sy corners in subpixels, counter-clockwise @param t triangle of each row @param py the row
    """
    low, high = x0[t], x1[t] - 1
    half = SUBPIXELS // 2
    cy = py * SUBPIXELS + half
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        from_x, from_y = sx[t, j], sy[t, j]
        ex, ey = sx[t, k] - from_x, sy[t, k] - from_y
        owns = (ey < 0) | ((ey == 0) & (ex > 0))
        # A texel is inside where rest - ey * SUBPIXELS * px >= 0.
        rest = ex * (cy - from_y) - ey * (half - from_x) - np.where(owns, 0, 1)
        bound = rest // np.maximum(np.abs(ey) * SUBPIXELS, 1)
        high = np.where(ey > 0, np.minimum(high, bound), high)
        low = np.where(ey < 0, np.maximum(low, -bound), low)
        high = np.where((ey == 0) & (rest < 0), low - 1, high)
    return low, np.maximum(high - low + 1, 0)


def shares(sx, sy, area, t, px, py):
    """Returns barycentric coordinates, on the screen, of texels in triangles."""
    half = SUBPIXELS // 2
    cx, cy = px * SUBPIXELS + half, py * SUBPIXELS + half
    edges = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        edges.append((sx[t, k] - sx[t, j]) * (cy - sy[t, j]) - (sy[t, k] - sy[t, j]) * (cx - sx[t, j]))
    return np.stack(edges, 1) / area[t][:, None]


class Raster:
    """Depth, owner and slopes of the nearest surface of each texel of a viewport."""

    def __init__(self, width, height, reversed_):
        self.width, self.height, self.reversed = width, height, reversed_
        count = width * height
        self.depth = np.full(count, 0.0 if reversed_ else 1.0)  # with polygon offset
        self.plain = np.full(count, np.nan)                     # without
        self.owner = np.full(count, -1, np.int64)               # triangle of the last draw() that is nearest
        self.tag = np.full(count, -1, np.int64)
        self.shift = (0.0, 0.0)  # of the sample from the middle of its pixel, in pixels

    def draw(self, clip, state, tag, step=None, keep=None):
        """Draws triangles, (n, 3, 4) clip positions in the orientation of the target's rows.

        @param step unit of the polygon offset; None: that of float depths
        @param keep function of (triangle, barycentric coordinates) that drops texels by a mask
        """
        if len(clip) == 0:
            return
        triangles, owners = clip_far_out(clip, np.arange(len(clip)))
        if len(triangles) == 0:
            return
        # Rasterisers compute with 32 bits.
        single = np.float32
        ndc = triangles[:, :, :3].astype(single) * (single(1) / triangles[:, :, 3:4].astype(single))
        if state.flipped:
            ndc = ndc * np.array([1, -1, 1], single)
        x = ndc[:, :, 0] * single(self.width / 2) + single(self.width / 2)
        y = ndc[:, :, 1] * single(self.height / 2) + single(self.height / 2)
        if self.shift != (0.0, 0.0):
            x, y = x - single(self.shift[0]), y - single(self.shift[1])
        low, high = state.depth_range
        z = ndc[:, :, 2]
        if state.negative_one:
            z = z * single((high - low) / 2) + single((high + low) / 2)
        elif (low, high) != (0.0, 1.0):
            z = z * single(high - low) + single(low)
        limit = 1 << 29  # products of two fit in 64 bits
        sx = np.clip(np.rint(x.astype(float) * SUBPIXELS), -limit, limit)
        sy = np.clip(np.rint(y.astype(float) * SUBPIXELS), -limit, limit)
        area = (sx[:, 1] - sx[:, 0]) * (sy[:, 2] - sy[:, 0]) - (sx[:, 2] - sx[:, 0]) * (sy[:, 1] - sy[:, 0])
        ccw = area > 0 if not state.flipped else area < 0
        front = ccw == state.front_ccw
        visible = (area != 0) & np.isfinite(area)
        if state.cull in ("back", "both"):
            visible &= front
        if state.cull in ("front", "both"):
            visible &= ~front
        chosen = np.nonzero(visible)[0]
        if len(chosen) == 0:
            return
        sx, sy, z, area, owners = sx[chosen], sy[chosen], z[chosen], area[chosen], owners[chosen]
        # Edges are those of rounded corners, planes of depth those of the corners themselves.
        tx, ty, z = x[chosen].astype(float), y[chosen].astype(float), z.astype(float)
        back = area < 0
        for values in (sx, sy, tx, ty, z):
            values[back] = values[back][:, [0, 2, 1]]
        swapped = back
        area = np.abs(area)
        # Plane of depth per texel.
        ax, ay, az = (tx[:, 1] - tx[:, 0]), (ty[:, 1] - ty[:, 0]), z[:, 1] - z[:, 0]
        bx, by, bz = (tx[:, 2] - tx[:, 0]), (ty[:, 2] - ty[:, 0]), z[:, 2] - z[:, 0]
        true_area = ax * by - bx * ay
        pixels = area / SUBPIXELS ** 2
        over = 1 / np.where(np.abs(true_area) < 1e-3 * pixels, pixels, true_area)
        dzdx, dzdy = (az * by - bz * ay) * over, (bz * ax - az * bx) * over
        origin = z[:, 0] - (dzdx * (tx[:, 0] - 0.5) + dzdy * (ty[:, 0] - 0.5))
        slope = np.maximum(np.abs(dzdx), np.abs(dzdy))
        if step is None:
            exponent = np.floor(np.log2(np.maximum(np.abs(z).max(1), 1e-38)))
            unit = 2.0 ** (exponent - 23)
        else:
            unit = step * state.unit_steps
        offset = state.factor * slope + state.units * unit
        if state.clamp > 0:
            offset = np.minimum(offset, state.clamp)
        elif state.clamp < 0:
            offset = np.maximum(offset, state.clamp)
        half = SUBPIXELS // 2
        x0 = np.clip(np.ceil((sx.min(1) - half) / SUBPIXELS), 0, self.width).astype(np.int64)
        x1 = np.clip(np.floor((sx.max(1) - half) / SUBPIXELS) + 1, 0, self.width).astype(np.int64)
        y0 = np.clip(np.ceil((sy.min(1) - half) / SUBPIXELS), 0, self.height).astype(np.int64)
        y1 = np.clip(np.floor((sy.max(1) - half) / SUBPIXELS) + 1, 0, self.height).astype(np.int64)
        sx, sy = sx.astype(np.int64), sy.astype(np.int64)
        lowest, highest = min(low, high), max(low, high)
        z_least, z_most = z.min(1), z.max(1)
        heights = np.where(x1 > x0, np.maximum(y1 - y0, 0), 0)
        for triangle, row in runs(heights, CHUNK):
            rows = y0[triangle] + row
            first, count = spans(sx, sy, triangle, rows, x0, x1)
            for place, column in runs(count, CHUNK):
                t, px, py = triangle[place], first[place] + column, rows[place]
                plain = np.clip(origin[t] + dzdx[t] * px + dzdy[t] * py, z_least[t], z_most[t])
                depth = plain + (offset[t] if np.ndim(offset) else offset)
                if state.depth_clamp:
                    depth, kept = np.clip(depth, lowest, highest), np.ones(len(t), bool)
                else:
                    kept = (plain >= lowest) & (plain <= highest)
                    depth = np.clip(depth, 0, 1)
                if keep is not None and kept.any():
                    share = shares(sx, sy, area, t, px, py)
                    turned = swapped[t]
                    share[turned] = share[turned][:, [0, 2, 1]]
                    kept &= keep(owners[t], share)
                flat = (py * self.width + px)[kept]
                self.store(flat, depth[kept], plain[kept], owners[t[kept]], tag)

    def store(self, flat, depth, plain, owners, tag):
        """Keeps what is nearest in each texel; of equal depths the last."""
        (np.maximum if self.reversed else np.minimum).at(self.depth, flat, depth)
        nearest = depth == self.depth[flat]
        places = flat[nearest]
        self.plain[places] = plain[nearest]
        self.owner[places] = owners[nearest]
        self.tag[places] = tag

    def covered(self):
        return self.tag >= 0


def step_of(fmt):
    """Returns the step of a depth format, or None for floats."""
    if fmt.startswith("D16"):
        return 1 / 65535
    if fmt.startswith("D24"):
        return 1 / 16777215
    return None


def compare_depths(captured, own, both, step):
    """Returns median and 99th percentile of the distance in steps, and the median signed difference."""
    if not both.any():
        return {"texels": 0}
    difference = captured[both] - own[both]
    # Rasterisers interpolate floats with an error of the last place of 1, however small the depth is.
    steps = np.abs(difference) / (step if step else 2.0 ** -23)
    return {"texels": int(both.sum()), "median_steps": float(np.median(steps)),
            "percentile_99_steps": float(np.percentile(steps, 99)), "median": float(np.median(difference))}


def fit_bias(difference, cosine):
    """Fits a shift of depth to 1, tan(angle) and 1 - n.l. Returns the coefficients and the residual (RMS)."""
    tangent = np.sqrt(np.maximum(1 - cosine ** 2, 0)) / np.maximum(cosine, 1e-3)
    good = np.isfinite(difference) & (cosine > 0.05)
    if good.sum() < 16:
        return None
    table = np.stack([np.ones(good.sum()), tangent[good], 1 - cosine[good]], 1)
    values = difference[good]
    for _ in range(3):
        solution = np.linalg.lstsq(table, values, rcond=1e-9)[0]
        error = values - table @ solution
        spread = 1.4826 * np.median(np.abs(error)) + 1e-12
        inside = np.abs(error) < 6 * spread
        if inside.all() or inside.sum() < 16:
            break
        table, values = table[inside], values[inside]
    left = np.abs(difference[good] - np.stack([np.ones(good.sum()), tangent[good], 1 - cosine[good]], 1) @ solution)
    return {"constant": float(solution[0]), "tangent": float(solution[1]), "one_minus_cosine": float(solution[2]),
            "residual": float(np.sqrt(np.mean(error ** 2))), "median_error": float(np.median(left)),
            "percentile_99_error": float(np.percentile(left, 99)), "unit": "depth"}


def unit_steps_of(difference, units, step):
    """Returns how many steps of a format a driver takes for a unit of polygon offset, or None.

    OpenGL leaves the unit to the driver. Mesa's llvmpipe takes two steps, other drivers take one.
    @param difference captured minus rebuilt depths, drawn with one step a unit
    """
    if step is None or units == 0 or len(difference) == 0:
        return None
    more = float(np.median(difference)) / (units * step)
    for steps in (2, 4):
        if abs(more - (steps - 1)) < 0.25:
            return steps
    return None
