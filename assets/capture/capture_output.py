"""Writes chosen maps of a capture as a bundle, with scene, camera, picture and the numbers of the gate."""
import os

import numpy as np
import renderdoc as rd

import capture_bundle as bundle
import capture_cube as cube
import capture_engines as engines
import capture_fit as fit
import capture_frame as frame
import capture_gate as gate
import capture_stream as stream
from capture_reading import REVERSED_FUNCTIONS, CaptureError

FORMATS = {"D16": "d16", "D24": "d24", "D32": "d32f"}


def depth_format(name):
    for start, key in FORMATS.items():
        if name.startswith(start):
            return key
    if name.startswith("R16") and "FLOAT" in name:
        return "r16f"
    return "r32f"


def import_maps(capture, chosen, options, say):
    notes = []
    passes = [part for _, part in chosen if part is not None]
    if len(chosen) > frame.MAX_MAPS:
        notes.append("The capture has %d maps; the first %d are written." % (len(chosen), frame.MAX_MAPS))
        chosen = chosen[:frame.MAX_MAPS]
        passes = [part for _, part in chosen if part is not None]
    readers = sorted({e for candidate, _ in chosen for e in candidate.readers})
    camera_events = camera_draws(capture, readers)
    total = max(1, sum(len(p.events) for p in passes) + len(camera_events))
    done = [0]

    def report():
        done[0] += 1
        say(progress=0.1 + 0.6 * min(1, done[0] / total), label="reading draws")

    camera = frame.Pass(0, camera_events)
    if camera_events:
        capture.go(camera_events[0])
        camera.state, _ = capture.state(capture.control.GetPipelineState())
        camera.viewport = camera.state.viewport
    everything = passes + ([camera] if camera_events else [])
    if not capture.vulkan and total > stream.MANY_DRAWS:
        stream.read_passes(capture, everything, report, notes)
    else:
        for part in everything:
            frame.read_pass(capture, part, report)
        frame.find_matrices(everything, notes)
    gates = []
    maps = []
    scene = frame.SceneWriter()
    folder = options.output
    os.makedirs(folder, exist_ok=True)
    masks = {}
    for number, (candidate, part) in enumerate(chosen):
        say(progress=0.7 + 0.2 * number / len(chosen), label="comparing map %d of %d" % (number + 1, len(chosen)))
        maps_of(capture, candidate, part, number, folder, maps, gates, scene, notes, masks, camera)
    bare = not maps and all(part is None for _, part in chosen)
    if bare:
        maps = [bare_map(capture, candidate, folder, notes) for candidate, _ in chosen]
        maps = [entry for entry in maps if entry is not None]
    if not maps:
        raise CaptureError("holds shadow maps, but none of their light matrices could be found")
    sizes = {}
    for entry in maps:
        image = entry["map"]["image"]
        sizes.setdefault((image["width"], image["height"]), []).append(entry)
    if len(sizes) > 1:
        size = max(sizes, key=lambda s: len(sizes[s]))
        left = sum(len(v) for k, v in sizes.items() if k != size)
        notes.append("%d maps of another size than %d x %d are left out; pick them by themselves." %
                     (left, size[0], size[1]))
        maps = sizes[size]
    if not bare:
        share_meaning(maps)
        maps = add_missing_faces(capture, maps, folder, notes)
    camera_entry = None if bare else camera_of(capture, camera, masks, scene, gates, notes)
    say(progress=0.95, label="writing")
    lights = []
    for group in frame.group_lights(maps):
        kind = group[0]["kind"]
        light = {"name": "texture %d%s" % (group[0]["texture"],
                                          "" if len(group) > 1 else ", slice %d" % group[0]["slice"])}
        if kind[0] == "directional":
            light["type"] = "directional"
            light["direction"] = [float(v) for v in kind[1]]
            if len(group) > 1:
                light["choice"] = "map"
        else:
            light["type"] = "point" if len(group) == 6 else "spot"
            light["position"] = [float(v) for v in kind[1]]
        light["lookup"] = look_up(capture, group[0]["candidate"], folder, notes)
        if not bare:
            group = engine_knowledge(capture, group, light, camera_entry is not None, notes)
        light["maps"] = [entry["map"] for entry in group]
        lights.append(light)
    result = {"bundle": 1, "made_by": "%s capture, RenderDoc %s" % (capture.driver, rd.GetVersionString())}
    if not bare:
        scene.scene.write(os.path.join(folder, "scene.glb"))
        result["scene"] = "scene.glb"
    if camera_entry:
        result["camera"] = camera_entry
    if picture(capture, folder):
        result["picture"] = "picture.png"
    result["lights"] = lights
    result["notes"] = notes
    result["extras"] = {"gate": gates}
    bundle.write_json(folder, clean(result))
    say(done=True, maps=len(maps), lights=len(lights), nodes=len(scene.scene.nodes), gate=clean(gates), notes=notes)


def clean(value):
    """Replaces numbers that JSON cannot hold by null."""
    if isinstance(value, dict):
        return {k: clean(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [clean(v) for v in value]
    if isinstance(value, (float, np.floating)):
        return float(value) if np.isfinite(value) else None
    if isinstance(value, np.integer):
        return int(value)
    return value


def maps_of(capture, candidate, part, number, folder, maps, gates, scene, notes, masks, camera):
    info = capture.textures[candidate.texture]
    name = info.format.Name()
    if part is None:
        notes.append("Texture %d: texels, no caster pass: an earlier frame drew it, so its light is unknown." %
                     candidate.texture)
        return
    label = "texture %d, slice %d, %d x %d at %d, %d" % (
        (candidate.texture, part.slice) + tuple(int(v) for v in (part.viewport[2], part.viewport[3],
                                                                part.viewport[0], part.viewport[1])))
    if part.matrix is None:
        notes.append("%s: no light matrix could be found." % label)
        return
    capture.go(part.events[-1])
    image = capture.texels(candidate.texture, 0, part.slice)
    if image is None:
        notes.append("%s: its format %s cannot be read." % (label, name))
        return
    bad = int((~np.isfinite(image)).sum())
    if bad:
        notes.append("%s: %d texels hold no number (NaN or infinite)." % (label, bad))
    part.matrix = frame.normalise_depth_range(part.matrix, part.state)
    reversed_ = part.state.function in REVERSED_FUNCTIONS
    numbers = {"map": number, "name": label, "not_finite": bad, "matrix": part.method}
    colour = candidate.kind == "colour"
    clear_image = None
    if colour:
        capture.go(part.events[0] - 1)
        clear_image = capture.texels(candidate.texture, 0, part.slice)
    step_format = name if not colour else "D32"
    numbers.update(frame.gate_of(capture, part, image, step_format, clear_image, colour, lambda: None, masks))
    gates.append(numbers)
    if numbers.get("shader_bias"):
        bias = numbers["caster_bias"]
        frame.unmoved_positions(part, [camera] + [entry["part"] for entry in maps], bias)
        notes.append("%s: the casters' shader moves depths: by %.3g %+.3g tan(angle) %+.3g (1 - n.l), residual %.3g." % (
            label, bias["constant"], bias["tangent"], bias["one_minus_cosine"], bias["residual"]))
    if not numbers["passed"]:
        notes.append("%s: the casters drawn again differ from the map more than they should." % label)
    x, y, w, h = frame.viewport_part(part, image)
    # Each pass has an image of its own. Other parts of an atlas still hold an earlier frame now, and a later pass may
    # draw over this part.
    own_image = image_of("map_%d.raw" % number, info, image, (x, y, w, h), part.state.flipped, folder)
    drawn = []
    for draw in part.draws:
        drawn += scene.add(part, draw, True)
    stored = {k: v for k, v in part.stored.items() if k in ("stored", "exponent", "range_m")}
    if colour:
        if info.format.compCount >= 2 and stored["stored"] == "linear":
            stored["stored"] = "moments"
        stored["clear"] = float(clear_image[y, x, 0])
        if "plane" in part.stored:
            # A bundle has no word for it: the depths that the texels stand for are written.
            notes.append("%s: a texel is linear in the world position, by %s, and not between the planes of the "
                         "light's matrix. The depths that follow are written." %
                         (label, ", ".join("%.6g" % v for v in part.stored["plane"])))
            file = "depth_" + own_image["file"]
            depths = frame.depths_of_plane(part, image[y:y + h, x:x + w, 0], clear_image[y:y + h, x:x + w, 0],
                                           info.format.compByteWidth == 2)
            bundle.write_raw(os.path.join(folder, file), depths.astype("<f4"))
            own_image = dict(own_image, file=file, format="f32", channels=1)
            stored = {"stored": "depth"}
    first = part.draws[0].state
    kind = fit.light_of(part.matrix, reversed_, part.state.negative_one)
    entry = {
        "image": own_image, "clip_from_world": bundle.columns(part.matrix),
        "depth": {"range": "-1..1" if part.state.negative_one else "0..1", "reversed": reversed_,
                  "format": depth_format(name), **stored},
        "raster": {"offset_factor": first.factor, "offset_units": first.units, "offset_clamp": first.clamp,
                   "cull": most_common([d.state.cull for d in part.draws]),
                   # The scene has the winding of glTF, which a mirrored map turns around.
                   "front": "cw" if fit.is_mirrored(part.matrix, kind) else "ccw",
                   "depth_clamp": bool(first.depth_clamp)},
        "drawn": sorted(set(drawn)),
        "extras": {"gate": number, "matrix": part.method, "front_in_engine": "ccw" if first.front_ccw else "cw"},
    }
    maps.append({"map": entry, "kind": kind, "texture": candidate.texture, "slice": part.slice,
                 "candidate": candidate, "matrix": part.matrix,
                 "viewport": part.viewport, "region": (x, y, w, h), "negative_one": part.state.negative_one,
                 "part": part, "is_empty": numbers["captured_texels"] == 0})


def image_of(file, info, image, region, flipped, folder):
    """Writes the texels of a region of one slice. Returns the image of a map in the bundle."""
    x, y, w, h = region
    image = image[y:y + h, x:x + w]
    values, name = image[:, :, 0], info.format.Name()
    if name.startswith("D16"):
        bundle.write_raw(os.path.join(folder, file), np.rint(values * 65535).astype("<u2"))
        kind, channels = "u16", 1
    elif name.startswith("D24"):
        bundle.write_raw(os.path.join(folder, file), np.rint(values * 16777215).astype("<u4"))
        kind, channels = "u24", 1
    else:
        bundle.write_raw(os.path.join(folder, file), image.astype("<f4"))
        kind, channels = "f32", image.shape[2]
    return {"file": file, "first_row": "top" if flipped else "bottom", "width": w, "height": h, "format": kind,
            "channels": channels, "channel": 0}


def add_missing_faces(capture, maps, folder, notes):
    """Adds faces of point lights into which the frame drew nothing. Returns all maps."""
    groups = {}
    for entry in maps:
        if entry["kind"][0] == "local":
            place = tuple(np.round(entry["kind"][1], 3))
            groups.setdefault((entry["texture"], place), []).append(entry)
    result = list(maps)
    for (texture, _), group in groups.items():
        info = capture.textures[texture]
        first = group[0]
        if any(e["region"] != first["region"] for e in group):
            continue
        taken = {e["slice"] for e in maps if e["texture"] == texture}
        faces = cube.missing_faces([(e["slice"], e["matrix"], e["kind"][1]) for e in group], info.arraysize)
        if any(slice_ in taken for slice_, _ in faces):
            continue
        for slice_, matrix in faces:
            capture.go(first["candidate"].readers[0])
            image = capture.texels(texture, 0, slice_)
            if image is None:
                continue
            x, y, w, h = first["region"]
            part = image[y:y + h, x:x + w, 0]
            is_empty = bool((part == part.flat[0]).all())
            flipped = first["map"]["image"]["first_row"] == "top"
            entry = dict(first["map"], image=image_of("map_%d_%d.raw" % (texture, slice_), info, image, first["region"],
                                                       flipped, folder),
                         clip_from_world=bundle.columns(matrix), extras={"matrix": "from the other faces"})
            if is_empty:
                entry["drawn"] = []
            else:
                entry.pop("drawn", None)
                notes.append("Texture %d, slice %d: an earlier frame drew this face, so its casters are unknown." % (
                    texture, slice_))
            result.append(dict(first, map=entry, slice=slice_, matrix=matrix))
    order = {id(e): (maps.index(next(m for m in maps if m["texture"] == e["texture"])), e["slice"]) for e in result}
    return sorted(result, key=lambda e: order[id(e)]) if len(result) > len(maps) else maps


def share_meaning(maps):
    """Gives a map without casters the meaning of its texels from another slice of its texture."""
    for entry in maps:
        if not entry["is_empty"]:
            continue
        for other in maps:
            if other["texture"] == entry["texture"] and not other["is_empty"]:
                depth = other["map"]["depth"]
                entry["map"]["depth"].update({k: depth[k] for k in ("stored", "range_m", "exponent") if k in depth})
                break


def bare_map(capture, candidate, folder, notes):
    """Writes a map without a caster pass: its texels as a height field over a unit square."""
    info = capture.textures[candidate.texture]
    capture.go(candidate.readers[0] - 1)
    image = capture.texels(candidate.texture)
    if image is None:
        return None
    bad = int((~np.isfinite(image)).sum())
    if bad:
        notes.append("Texture %d: %d texels hold no number (NaN or infinite)." % (candidate.texture, bad))
    file = "map_%d_0.raw" % candidate.texture
    bundle.write_raw(os.path.join(folder, file), image.astype("<f4"))
    stored = {"stored": "depth"}
    largest = float(np.nanmax(image[:, :, 0][np.isfinite(image[:, :, 0])])) if np.isfinite(image).any() else 0.0
    if largest > 1.5:
        stored = {"stored": "exponential", "exponent": float(np.ceil(np.log(largest)))}
        notes.append("Texture %d: values up to %.6g are shown as exponential depths of exponent %g, which is a guess." %
                     (candidate.texture, largest, stored["exponent"]))
    # Clip z rises along the light, which shines downwards.
    matrix = np.array([[1.0, 0, 0, 0], [0, 0, -1.0, 0], [0, -1.0, 0, 0.5], [0, 0, 0, 1.0]])
    notes.append("Texture %d: its light's matrix is a stand-in: a square of 2 m from above." % candidate.texture)
    entry = {"image": {"file": file, "first_row": "bottom", "width": info.width, "height": info.height, "format": "f32",
                       "channels": image.shape[2], "channel": 0},
             "clip_from_world": bundle.columns(matrix),
             "depth": {"range": "0..1", "reversed": False, "format": depth_format(info.format.Name()), **stored},
             "extras": {"state": "texels, no caster pass"}}
    return {"map": entry, "kind": ("directional", np.array([0, -1.0, 0])), "texture": candidate.texture, "slice": 0,
            "candidate": candidate}


def most_common(values):
    return max(set(values), key=values.count)


def camera_draws(capture, readers):
    """Returns the draws of the picture: those with the targets of the first draw that reads a map."""
    if not readers:
        return []
    counts = {}
    for event in readers:
        action = capture.by_event[event]
        key = (int(action.outputs[0]), int(action.depthOut))
        counts[key] = counts.get(key, 0) + 1
    target = max(counts, key=counts.get)
    if not target[1]:
        return []
    return [a.eventId for a in capture.actions
            if a.flags & rd.ActionFlags.Drawcall and a.numIndices > 0 and int(a.depthOut) == target[1]]


def camera_of(capture, camera, masks, scene, gates, notes):
    """Adds the receivers and compares their depth with the captured one. Returns the camera of the bundle."""
    if camera.matrix is None:
        notes.append("The camera could not be found; a camera that shows the scene is used.")
        return None
    depth = int(capture.by_event[camera.events[-1]].depthOut)
    info = capture.textures[depth]
    camera.matrix = frame.normalise_depth_range(camera.matrix, camera.state)
    camera.state.depth_range = (0.0, 1.0)
    writes = [d.state.function for d in camera.draws]
    reversed_ = most_common(writes) in REVERSED_FUNCTIONS
    entry = {"clip_from_world": bundle.columns(camera.matrix), "width": int(camera.viewport[2]),
             "height": int(camera.viewport[3]),
             "depth": {"range": "-1..1" if camera.state.negative_one else "0..1", "reversed": reversed_}}
    receivers = []
    for draw in camera.draws:
        draw.mask, draw.mask_unknown, draw.mask_wrong = None, False, 0.0
        # A quad over the picture is no receiver: its w is 1 while the camera's changes.
        quad = np.ptp(draw.clips[0][:, 3]) == 0 and draw.clips[0][0, 3] == 1 and len(draw.indices) <= 6 and \
            np.abs(camera.matrix[3, :3]).max() > 1e-6
        if not quad:
            receivers.append(draw)
    left_out = len(camera.draws) - len(receivers) + camera.unread
    camera.draws = receivers
    if info.msSamp in SAMPLE_SHIFTS and camera.viewport == (0, 0, info.width, info.height):
        gates.append(camera_gate(capture, camera, depth, info, reversed_, masks, left_out, notes))
    else:
        notes.append("The camera's depth is drawn in parts or has %d samples, and was not compared." % info.msSamp)
    for draw in receivers:
        scene.add(camera, draw, False)
    return entry


# Places of the first sample of a pixel, by the number of samples, as drivers have them.
SAMPLE_SHIFTS = {1: [(0.0, 0.0)], 2: [(0.25, 0.25), (0.25, -0.25)], 4: [(-0.125, -0.375), (-0.125, 0.375)],
                 8: [(0.0625, -0.1875), (0.0625, 0.1875)]}


def camera_gate(capture, camera, depth, info, reversed_, masks, left_out, notes):
    """Draws the receivers again and compares their depth with the captured one. Returns the numbers."""
    capture.go(camera.events[-1])
    captured = capture.texels(depth)[:, :, 0].ravel()
    tries = [camera_agreement(capture, camera, captured, info, reversed_, masks, shift)
             for shift in SAMPLE_SHIFTS[max(1, info.msSamp)]]
    share, pixels, hidden = max(tries)
    if share < 0.995:
        notes.append("The camera's depth agrees on %.1f %% of the pixels only; receivers may be missing." %
                     (100 * share))
    return {"name": "camera", "pixels": pixels, "agree": share, "passed": share >= 0.995,
            "matrix": camera.method, "matrix_agreement": camera.agreement, "draws": len(camera.draws),
            "left_out": left_out, "masked_pixels_left_out": hidden}


def camera_agreement(capture, camera, captured, info, reversed_, masks, shift):
    """Returns the share of pixels with the captured depth, the number of pixels, and that of pixels left out."""
    step = gate.step_of(info.format.Name())
    raster = gate.Raster(info.width, info.height, reversed_)
    raster.shift = shift

    def draw_all(target, draws):
        for number, draw in enumerate(draws):
            if not draw.state.writes or draw.state.viewport != camera.viewport:
                continue
            frame.raster_draw(target, camera, draw, number, step, draw.mask)

    draw_all(raster, [d for d in camera.draws if not d.discards])
    seen = captured != (0.0 if reversed_ else 1.0)
    masked = [d for d in camera.draws if d.discards]
    unknown = gate.Raster(info.width, info.height, reversed_)
    unknown.shift = shift
    if masked:
        frame.choose_masks(capture, camera, captured, seen, raster, step, masks)
        draw_all(raster, [d for d in masked if not d.mask_unknown])
        draw_all(unknown, [d for d in masked if d.mask_unknown])
    hidden = unknown.covered() & ((unknown.depth >= raster.depth) if reversed_ else (unknown.depth <= raster.depth))
    seen &= ~hidden
    size = 4 * (step or 2.0 ** -24)
    near = np.abs(captured - raster.depth) <= np.maximum(size, 1e-5 * (captured if reversed_ else 1 - captured))
    return (float(near[seen].mean()) if seen.any() else 0.0), int(seen.sum()), int(hidden.sum())


def picture(capture, folder):
    """Writes the frame's last picture. Returns whether there is one."""
    target = 0
    for action in reversed(capture.actions):
        if action.flags & rd.ActionFlags.Present and int(action.copyDestination):
            target = int(action.copyDestination)
            break
        if action.flags & rd.ActionFlags.Drawcall and int(action.outputs[0]):
            target = int(action.outputs[0])
            break
    info = capture.textures.get(target)
    if info is None or info.msSamp > 1:
        return False
    capture.go(capture.actions[-1].eventId)
    pixels = capture.texels(target)
    if pixels is None or pixels.shape[2] < 3:
        return False
    rgb = np.rint(np.clip(np.nan_to_num(pixels[:, :, :3]), 0, 1) * 255).astype(np.uint8)
    if not capture.vulkan:
        rgb = rgb[::-1]
    bundle.write_png(os.path.join(folder, "picture.png"), np.ascontiguousarray(rgb))
    return True


COMPARE = {"Less": "less", "LessEqual": "less-equal", "Greater": "greater", "GreaterEqual": "greater-equal"}
WRAP = {"ClampEdge": "clamp", "ClampBorder": "border", "Wrap": "repeat"}


def look_up(capture, candidate, folder, notes):
    """Returns what is known of the look-up: sampler and shader text. Bias stays unknown."""
    result = {}
    event = candidate.readers[len(candidate.readers) // 2]
    capture.go(event)
    pipe = capture.control.GetPipelineState()
    try:
        sampler = sampler_of(capture, pipe, candidate.texture)
    except (AttributeError, IndexError):
        sampler = None
    if sampler is not None:
        compare, magnify, wrap = sampler
        if compare in COMPARE:
            result["compare"] = COMPARE[compare]
        if magnify in ("Point", "Linear"):
            result["filter"] = "nearest" if magnify == "Point" else "linear"
        if wrap in WRAP:
            result["wrap"] = WRAP[wrap]
    reflection = pipe.GetShaderReflection(rd.ShaderStage.Pixel)
    if reflection is not None:
        glsl = reflection.encoding == rd.ShaderEncoding.GLSL
        file = "lookup_%d.%s" % (candidate.texture, "glsl" if glsl else "spvasm")
        with open(os.path.join(folder, file), "w") as out:
            out.write(capture.shader_text(pipe, reflection))
        result["shader"] = file
    return result


def engine_knowledge(capture, group, light, has_camera, notes):
    """Adds bias and intervals where the shaders are those of a known engine. Returns the maps in order of choice."""
    candidate = group[0]["candidate"]
    event = candidate.readers[len(candidate.readers) // 2]
    found = engines.known(capture, event, group, capture.textures[candidate.texture])
    if found:
        light["extras"] = {"engine": found["engine"]}
        notes += ["%s: %s" % (light["name"], note) for note in found["notes"]]
    if "bias" in found:
        light["lookup"]["bias"] = found["bias"]
        known = ["%s %.4g" % (k, found["bias"][k]) for k in ("constant", "slope", "normal") if k in found["bias"]]
        notes.append("%s: bias of the look-up, by constants of %s: %s (%s)." %
                     (light["name"], found["engine"], ", ".join(known), found["bias"]["units"]))
    for number, entry in enumerate(group if found.get("engine") == "Godot 3" else []):
        moved = engines.godot_casters(capture, entry["part"])
        if moved:
            entry["map"]["raster"].update(moved)
            notes.append("%s, map %d: Godot 3 moves its casters by %.4g + %.4g (1 - n.l) metres along the light." %
                         (light["name"], number, moved["shift_m"], moved["grazing_shift_m"]))
    if "intervals" in found and has_camera:
        for entry, interval in zip(group, found["intervals"]):
            entry["map"]["interval"] = interval
        light["choice"] = "interval"
        return [entry for _, entry in sorted(zip(found["order"], group), key=lambda pair: pair[0])]
    if len(group) > 1 and group[0]["kind"][0] == "directional":
        notes.append("%s: which map a point reads is unknown; the first that contains it is taken." % light["name"])
    return group


def sampler_of(capture, pipe, texture):
    """Returns compare function, magnification and wrap of the sampler that reads a texture."""
    if not capture.vulkan:
        state = capture.control.GetGLPipelineState()
        for unit, bound in enumerate(state.textures):
            if int(bound.resourceId) == texture:
                sampler = state.samplers[unit]
                compare = sampler.compareFunction.name if sampler.filter.filter == rd.FilterFunction.Comparison else ""
                return compare, sampler.filter.magnify.name, sampler.addressS.name
        return None
    state = capture.control.GetVulkanPipelineState()
    for group in state.graphics.descriptorSets:
        for binding in group.bindings:
            for bind in binding.binds:
                if int(bind.resourceResourceId) == texture:
                    compare = bind.compareFunction.name if bind.filter.filter == rd.FilterFunction.Comparison else ""
                    return compare, bind.filter.magnify.name, bind.addressU.name
    return None

