"""Draws of an OpenGL capture from its recorded calls, where replaying each draw would take too long.

Replay then reads a few draws of each pass and program, which give the rule for the others: which input is the
position, and which uniform and instance inputs make the world matrix.
"""
import numpy as np

import capture_fit as fit
import capture_frame as frame
from capture_reading import Draw

# Draws of a capture beyond which recorded calls are used.
MANY_DRAWS = 300
PROBES = 3

TYPES = {"GL_FLOAT": "<f4", "GL_HALF_FLOAT": "<f2", "GL_UNSIGNED_BYTE": "u1", "GL_BYTE": "i1",
         "GL_UNSIGNED_SHORT": "<u2", "GL_SHORT": "<i2"}
SCALES = {"GL_UNSIGNED_BYTE": 255.0, "GL_BYTE": 127.0, "GL_UNSIGNED_SHORT": 65535.0, "GL_SHORT": 32767.0}
INDICES = {"GL_UNSIGNED_BYTE": "u1", "GL_UNSIGNED_SHORT": "<u2", "GL_UNSIGNED_INT": "<u4"}
DRAWS = ("glDrawElements", "glDrawElementsInstanced", "glDrawRangeElements", "glDrawElementsBaseVertex",
         "glDrawRangeElementsBaseVertex", "glDrawElementsInstancedBaseVertex", "glDrawArrays", "glDrawArraysInstanced",
         "glDrawElementsInstancedBaseInstance", "glDrawElementsInstancedBaseVertexBaseInstance",
         "glDrawArraysInstancedBaseInstance")


def field(chunk, name):
    return chunk.FindChild(name)


def number(chunk, name, default=0):
    child = chunk.FindChild(name)
    return child.AsInt() if child is not None else default


def text(chunk, name):
    child = chunk.FindChild(name)
    return child.AsString() if child is not None else ""


def resource(chunk, name):
    child = chunk.FindChild(name)
    return child.AsResourceId() if child is not None else None


class Call:
    """State of one recorded draw."""

    __slots__ = ("event", "base_instance", "program", "attributes", "elements", "uniforms", "name", "mode", "count", "type", "offset",
                 "instances", "base", "first", "cull", "front_ccw", "generic")


def read_calls(capture):
    """Returns {event: Call} of all draws of the frame."""
    events = {}
    for action in capture.actions:
        for event in action.events:
            events[event.chunkIndex] = event.eventId
    arrays, elements, uniforms, generic = {}, {}, {}, {}
    program = vao = 0
    culling, side, ccw = None, None, None
    result = {}
    for place, chunk in enumerate(capture.structured.chunks):
        name = chunk.name
        if name == "glUseProgram":
            program = int(resource(chunk, "program"))
        elif name == "glBindVertexArray":
            vao = int(resource(chunk, "vaobj"))
        elif name in ("glVertexAttribPointer", "glVertexAttribIPointer"):
            owner = int(resource(chunk, "vaobj"))
            state = dict(arrays.get(owner, {}))
            index = number(chunk, "index")
            normalized = field(chunk, "normalized")
            old = state.get(index, {})
            state[index] = dict(old, buffer=resource(chunk, "buffer"), size=number(chunk, "size"),
                                type=text(chunk, "type"), stride=number(chunk, "stride"),
                                offset=number(chunk, "offset"),
                                normalized=normalized is not None and normalized.AsBool())
            arrays[owner] = state
        elif name in ("glEnableVertexAttribArray", "glDisableVertexAttribArray"):
            owner = int(resource(chunk, "vaobj"))
            state = dict(arrays.get(owner, {}))
            index = number(chunk, "index")
            state[index] = dict(state.get(index, {}), enabled=name.startswith("glEnable"))
            arrays[owner] = state
        elif name == "glVertexAttribDivisor":
            owner = int(resource(chunk, "vaobj"))
            state = dict(arrays.get(owner, {}))
            index = number(chunk, "index")
            state[index] = dict(state.get(index, {}), divisor=number(chunk, "divisor"))
            arrays[owner] = state
        elif name == "glVertexArrayElementBuffer":
            elements[int(resource(chunk, "vaobj"))] = resource(chunk, "buffer")
        elif name == "glBindBuffer" and text(chunk, "target") == "GL_ELEMENT_ARRAY_BUFFER":
            elements[vao] = resource(chunk, "buffer")
        elif name.startswith("glUniformMatrix4fv") or name.startswith("glProgramUniformMatrix4fv"):
            owner = resource(chunk, "Program")
            owner = int(owner) if owner is not None else program
            values = field(chunk, "values")
            matrix = np.array([values.GetChild(i).AsFloat() for i in range(min(16, values.NumChildren()))])
            if len(matrix) == 16:
                matrix = matrix.reshape(4, 4)
                transposed = field(chunk, "transpose")
                if not (transposed is not None and transposed.AsBool()):
                    matrix = matrix.T
                state = dict(uniforms.get(owner, {}))
                state[number(chunk, "location")] = matrix
                uniforms[owner] = state
        elif name == "glCullFace":
            side = text(chunk, "mode")
        elif name == "glFrontFace":
            ccw = text(chunk, "mode") == "GL_CCW"
        elif name in ("glEnable", "glDisable") and text(chunk, "cap") == "GL_CULL_FACE":
            culling = name == "glEnable"
        elif name in DRAWS and place in events:
            call = Call()
            call.event, call.program, call.name = events[place], program, name
            call.attributes, call.elements = arrays.get(vao, {}), elements.get(vao)
            call.uniforms = uniforms.get(program, {})
            call.mode, call.count, call.type = text(chunk, "mode"), number(chunk, "count"), text(chunk, "type")
            call.offset, call.base = number(chunk, "indices"), number(chunk, "basevertex")
            call.first, call.base_instance = number(chunk, "first"), number(chunk, "baseinstance")
            call.instances = number(chunk, "instancecount", 1) if "Instanced" in name else 1
            call.cull, call.front_ccw = (culling, side), ccw
            result[call.event] = call
    return result


def attribute_values(capture, attribute, rows):
    """Returns a (row, component) array of one vertex input."""
    kind = TYPES.get(attribute.get("type"))
    if kind is None or not attribute.get("enabled") or attribute.get("buffer") is None:
        return None
    data = np.frombuffer(capture.buffer(attribute["buffer"]), "u1")
    size = np.dtype(kind).itemsize * attribute["size"]
    stride = attribute["stride"] or size
    at = attribute["offset"] + rows * stride
    if len(at) == 0 or at.min() < 0 or at.max() + size > len(data):
        return None
    values = data[at[:, None] + np.arange(size)].copy().view(kind).astype(float)
    return values / SCALES[attribute["type"]] if attribute.get("normalized") and attribute["type"] in SCALES else values


def topology(mode):
    class Named:
        name = {"GL_TRIANGLES": "TriangleList", "GL_TRIANGLE_STRIP": "TriangleStrip",
                "GL_TRIANGLE_FAN": "TriangleFan"}.get(mode, "")
    return Named


class Rule:
    """How draws of one program make their positions, as one replayed draw shows."""

    def __init__(self, position, uniform, instanced, state, probe):
        self.position, self.uniform, self.instanced, self.state, self.probe = \
            position, uniform, instanced, state, probe


def instance_matrix(capture, call, instance):
    """Returns the matrix of three rows that inputs with a divisor hold, or None."""
    rows = [a for _, a in sorted(call.attributes.items()) if a.get("enabled") and a.get("divisor", 0) > 0 and
            a.get("size") == 4 and a.get("type") == "GL_FLOAT"][:3]
    if len(rows) < 3:
        return None
    values = [attribute_values(capture, a, np.array([call.base_instance + instance // a["divisor"]]))
              for a in rows]
    if any(v is None for v in values):
        return None
    return np.vstack([values[0], values[1], values[2], [[0, 0, 0, 1]]])


def find_rule(capture, call, probe, part):
    """Finds which uniform and instance inputs give the world matrices that replay found. None: none does."""
    index = attribute_index(probe)
    if probe.skinned or index is None:
        return None
    for location in [None] + sorted(call.uniforms):
        uniform = np.eye(4) if location is None else call.uniforms[location]
        for instanced in (False, True):
            good = True
            for i, clip in enumerate(probe.clips):
                world = uniform
                if instanced:
                    rows = instance_matrix(capture, call, i)
                    if rows is None:
                        good = False
                        break
                    world = uniform @ rows
                points, sample = fit.sample_points(probe.points, clip)
                if fit.scores((part.matrix @ world)[None], points, sample)[0] > 5 * fit.MATRIX_RESIDUAL:
                    good = False
                    break
            if good:
                return Rule(index, location, instanced, probe.state, probe)
    return None


def attribute_index(probe):
    return probe.locations.get(probe.position) if probe.position else None


def stream_draw(capture, call, rule, part):
    """Builds one draw from recorded calls."""
    from capture_reading import triangle_corners
    corners = triangle_corners(topology(call.mode), call.count)
    if corners is None or len(corners) == 0 or rule.position not in call.attributes:
        return None
    if "Elements" in call.name:
        kind = INDICES.get(call.type)
        if kind is None or call.elements is None:
            return None
        data = capture.buffer(call.elements)
        if call.offset + call.count * np.dtype(kind).itemsize > len(data):
            return None
        index = np.frombuffer(data, kind, call.count, call.offset).astype(np.int64)[corners] + call.base
    else:
        index = corners + call.first
    vertices, indices = np.unique(index, return_inverse=True)
    draw = Draw()
    draw.event, draw.indices, draw.state = call.event, indices, state_of(call, rule)
    probe = rule.probe
    for name, location in probe.locations.items():
        attribute = call.attributes.get(location)
        if attribute is None or attribute.get("divisor", 0) > 0:
            continue
        values = attribute_values(capture, attribute, vertices)
        if values is not None:
            draw.attributes[name] = values
    if probe.position not in draw.attributes:
        return None
    draw.position, draw.skinned = probe.position, False
    draw.values = fit.homogeneous(draw.attributes[draw.position])
    draw.points = draw.values[indices]
    draw.rank = int(np.linalg.matrix_rank(draw.points[:: max(1, len(draw.points) // 256)], tol=1e-9))
    draw.geometry = frame.geometry_key(draw)
    draw.vertex_shader, draw.pixel_shader = probe.vertex_shader, probe.pixel_shader
    draw.textures, draw.discards = probe.textures, probe.discards
    draw.error = probe.error
    uniform = np.eye(4) if rule.uniform is None else call.uniforms.get(rule.uniform)
    if uniform is None:
        return None
    draw.worlds = []
    for i in range(max(1, call.instances)):
        world = uniform
        if rule.instanced:
            rows = instance_matrix(capture, call, i)
            if rows is None:
                return None
            world = uniform @ rows
        draw.worlds.append(world)
        draw.clips.append(draw.points @ (part.matrix @ world).T)
    draw.mvp = part.matrix @ draw.worlds[0]
    return draw


def state_of(call, rule):
    """Returns the probe's state with the culling of this draw."""
    import copy
    state = copy.copy(rule.state)
    culling, side = call.cull
    if culling is not None and side is not None:
        state.cull = {"GL_BACK": "back", "GL_FRONT": "front"}.get(side, "both") if culling else "none"
    return state


def read_passes(capture, passes, report, notes):
    """Reads passes from recorded calls, with few replays, and finds their matrices."""
    calls = read_calls(capture)
    chosen = []
    for part in passes:
        programs = {}
        for event in part.events:
            call = calls.get(event)
            if call is None:
                # A kind of draw that is not read from calls is replayed.
                call = Call()
                call.event, call.program, call.count, call.uniforms, call.attributes = event, None, 0, {}, {}
            programs.setdefault(call.program, []).append(call)
        probes = {}
        for program, members in programs.items():
            probes[program] = spread(members, PROBES)
        chosen.append((programs, probes))
    samples = []
    for part, (programs, probes) in zip(passes, chosen):
        sample = frame.Pass(part.texture, sorted(c.event for members in probes.values() for c in members))
        sample.state = part.state
        frame.read_pass(capture, sample, report)
        samples.append(sample)
    frame.find_matrices(samples, notes, align=False)
    replayed = 0
    for part, sample, (programs, probes) in zip(passes, samples, chosen):
        if sample.matrix is None:
            continue
        part.matrix, part.method, part.agreement = sample.matrix, sample.method + ", recorded calls", sample.agreement
        part.places = sample.places
        by_event = {d.event: d for d in sample.draws}
        part.draws, part.unread = [], sample.unread
        for program, members in programs.items():
            rules = []
            for call in probes[program]:
                probe = by_event.get(call.event)
                rule = find_rule(capture, call, probe, part) if probe is not None and program is not None else None
                if rule is not None:
                    rules.append(rule)
            for call in members:
                draw = None
                if call.event in by_event:
                    draw = by_event[call.event]
                elif rules and program is not None:
                    draw = stream_draw(capture, call, rules[0], part)
                if draw is None:
                    draw = capture.draw(call.event)
                    replayed += 1
                    if draw is None or not frame.prepare(draw):
                        part.unread += 1
                        continue
                    single = frame.Pass(part.texture, [call.event])
                    single.matrix, single.draws = part.matrix, [draw]
                    frame.set_worlds(single, None)
                part.draws.append(draw)
                report()
        part.draws.sort(key=lambda d: d.event)
    frame.align_worlds([p for p in passes if p.matrix is not None], notes)
    notes.append("Draws were read from recorded calls; %d of them were replayed." %
                 (replayed + sum(len(s.draws) for s in samples)))


def spread(calls, count):
    """Chooses calls with different uniforms and many corners."""
    order = sorted(calls, key=lambda c: -min(c.count, 4000))
    result = order[:1]
    for call in order[1:]:
        if len(result) >= count:
            break
        if all(any(not np.array_equal(m, o.uniforms.get(k)) for k, m in call.uniforms.items()) for o in result):
            result.append(call)
    return result

