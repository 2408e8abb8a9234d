"""Bias and choice of cascades that look-up shaders of known engines read from constants with names.

Nothing else tells an engine's receiver-side bias: it is code. Shaders of other engines leave it unknown.
"""
import re

import numpy as np
import renderdoc as rd

from capture_reading import block_members
from capture_shader import live_text

# Distance of rows of two matrices of one map, as a share of the row.
SAME_ROWS = 1e-3
MAX_SETTINGS_BYTES = 4096


class LookUp:
    """Constants with names and live texts of the shaders of one draw that reads a map."""

    def __init__(self, capture, event):
        self.capture, self.event, self.settings = capture, event, None
        capture.go(event)
        pipe = capture.control.GetPipelineState()
        self.blocks, self.offsets, self.texts, self.defines = {}, {}, {}, {}
        for stage in (rd.ShaderStage.Vertex, rd.ShaderStage.Pixel):
            reflection = pipe.GetShaderReflection(stage)
            if reflection is None:
                continue
            glsl = reflection.encoding == rd.ShaderEncoding.GLSL
            text = capture.shader_text(pipe, reflection) if glsl else ""
            self.texts[stage] = live_text(text)
            self.defines.update(re.findall(r"^[ \t]*#define[ \t]+(\w+)[ \t]+(\S+)", text, re.M))
            for slot, block in enumerate(reflection.constantBlocks):
                bound = pipe.GetConstantBuffer(stage, slot, 0)
                if block.bufferBacked and not int(bound.resourceId):
                    continue
                values = capture.control.GetCBufferVariableContents(
                    pipe.GetGraphicsPipelineObject(), reflection.resourceId, stage, pipe.GetShaderEntryPoint(stage),
                    slot, bound.resourceId, bound.byteOffset, bound.byteSize)
                members = self.blocks.setdefault(block.name, {})
                # A block with an instance name is one member that has members.
                if len(values) == 1 and values[0].name == block.name:
                    values = values[0].members
                for value in values:
                    members[value.name] = numbers_of(value)
                self.offsets.setdefault(block.name, {}).update({v.byteOffset: v.name for v in block_members(block)})

    def buffer_bytes(self, name):
        """Returns the bytes of a buffer that the pixel shader reads as texels."""
        self.capture.go(self.event)
        pipe = self.capture.control.GetPipelineState()
        reflection = pipe.GetShaderReflection(rd.ShaderStage.Pixel)
        places = pipe.GetBindpointMapping(rd.ShaderStage.Pixel).readWriteResources
        for resource in reflection.readWriteResources:
            if resource.name != name:
                continue
            for bound in pipe.GetReadWriteResources(rd.ShaderStage.Pixel):
                if bound.bindPoint.bind == places[resource.bindPoint].bind and len(bound.resources) and \
                        int(bound.resources[0].resourceId) in self.capture.textures:
                    return bytes(self.capture.control.GetTextureData(bound.resources[0].resourceId,
                                                                     rd.Subresource(0, 0, 0)))[:MAX_SETTINGS_BYTES]
        return b""

    def text(self, stage):
        return self.texts.get(stage, "")

    def member(self, block, name):
        """Returns a member by the name that it has in this shader, or in another shader of the capture."""
        members = self.blocks.get(block, {})
        if name in members:
            return members[name], name
        offset = self.capture.member_offsets(block).get(name)
        other = self.offsets.get(block, {}).get(offset)
        return (members[other], other) if other in members else (None, None)


def shortest(value):
    """Returns the number with the fewest digits that is the same 32-bit float: 0.02, not 0.0199999996."""
    return float(str(np.float32(value)))


def numbers_of(variable):
    """Returns the numbers of a constant: a list of them for arrays, an array of rows for matrices."""
    if len(variable.members):
        return [numbers_of(m) for m in variable.members]
    count = max(1, variable.rows * variable.columns)
    if variable.type in (rd.VarType.UInt, rd.VarType.SInt, rd.VarType.Bool):
        return np.array(variable.value.u32v[:count], float)
    values = np.array([shortest(v) for v in variable.value.f32v[:count]])
    return values.reshape(variable.rows, variable.columns) if variable.rows > 1 else values


def texture_from_clip(entry, info):
    """Returns the matrix that takes clip positions of a map to coordinates of its whole texture."""
    x, y, width, height = entry["viewport"]
    result = np.eye(4)
    for axis, (start, size, whole) in enumerate(((x, width, info.width), (y, height, info.height))):
        result[axis, axis] = size / whole / 2
        result[axis, 3] = (start + size / 2) / whole
    return result


def same_rows(a, b):
    """Returns whether two matrices give the same x over w and y over w."""
    rows = [0, 1, 3]
    a, b = a[rows] / np.linalg.norm(a[rows]), b[rows] / np.linalg.norm(b[rows])
    return min(np.abs(a - b).max(), np.abs(a + b).max()) < SAME_ROWS * np.abs(a).max()


def number_of(matrices, entry, info):
    """Returns which of the look-up's matrices (texture from world) is that of a map, or None."""
    wanted = texture_from_clip(entry, info) @ entry["matrix"]
    found = [i for i, matrix in enumerate(matrices) if np.abs(matrix).max() > 0 and same_rows(matrix, wanted)]
    return found[0] if len(found) == 1 else None


def metres_towards_light(entry, matrix):
    """Returns how far a look-up matrix moves points towards the light, or None where it is no fixed length."""
    caster = entry["matrix"]
    inverse = np.linalg.inv(caster)
    low = -1.0 if entry["negative_one"] else 0.0
    moved = []
    for x, y, z in ((0, 0, 0.5), (0.5, 0.5, 0.3), (-0.5, 0.4, 0.7), (0.3, -0.6, 0.6), (-0.4, -0.4, 0.4)):
        point = inverse @ np.array([x, y, low + (1 - low) * z, 1.0])
        point = point / point[3]
        seen = matrix @ point
        seen = seen[2] / seen[3]
        wanted = low + (1 - low) * seen
        # The place along the ray that has the depth of the look-up.
        along = entry["kind"][1]
        if entry["kind"][0] != "directional":
            along = (point[:3] - along) / np.linalg.norm(point[:3] - along)
        start, step = caster @ point, caster @ np.append(along, 0.0)
        moved.append((start[2] - wanted * start[3]) / (step[2] - wanted * step[3]))
    moved = np.array(moved)
    if not np.isfinite(moved).all():
        return None
    middle = float(np.median(moved))
    ends = [inverse @ np.array([0, 0, z, 1.0]) for z in (low, 1.0)]
    length = np.linalg.norm(ends[1][:3] / ends[1][3] - ends[0][:3] / ends[0][3])
    # Constants have 32 bits.
    noise = 2e-6 * length
    if np.ptp(moved) > 0.02 * abs(middle) + 2 * noise:
        return None
    return 0.0 if abs(middle) < noise else middle


def godot(look_up, group, info):
    """Godot 3: the casters' shader moves depths, and the look-up moves nothing."""
    text = look_up.text(rd.ShaderStage.Pixel)
    splits, _ = look_up.member("DirectionalLightData", "shadow_split_offsets")
    scene = look_up.blocks.get("SceneData", {})
    if splits is None or not {"z_offset", "z_slope_scale", "camera_inverse_matrix"} <= set(scene):
        return None
    result = {"engine": "Godot 3", "notes": []}
    members = look_up.blocks["DirectionalLightData"]
    matrices = [members["shadow_matrix%d" % i] @ scene["camera_inverse_matrix"] for i in (1, 2, 3, 4)
                if "shadow_matrix%d" % i in members]
    count = len(group)
    places = [number_of(matrices[:count], entry, info) for entry in group]
    if sorted(p for p in places if p is not None) != list(range(count)):
        return result
    reads = re.search(r"sample_shadow\s*\(\s*directional_shadow\s*,[^;]*pssm_coord\s*\.\s*z\s*,", text)
    moved = [metres_towards_light(entry, matrices[place]) for entry, place in zip(group, places)]
    if reads and "normal_bias" not in text and "normal_offset" not in text and all(m == 0 for m in moved):
        result["bias"] = {"constant": 0, "slope": 0, "normal": 0, "units": "depth, depth, metres"}
    if count not in (2, 4):
        return result
    ends = [float(v) for v in splits.ravel()[:count]]
    starts = [0.0] + ends[:-1]
    if "pssm_blend" in text:
        # Each map is blended into the next over its whole interval.
        starts = [0.0, 0.0] + ends[:-2]
    result["order"] = places
    result["intervals"] = [[starts[p], ends[p]] for p in places]
    if "pssm_fade" in text:
        result["notes"].append("Godot 3 fades the shadow out over the last cascade's interval.")
    return result


def godot_casters(capture, part):
    """Returns how far Godot 3 moves its casters, as members of a map's raster state, or None."""
    scene = LookUp(capture, part.draws[0].event).blocks.get("SceneData", {})
    if not {"z_offset", "z_slope_scale"} <= set(scene):
        return None
    return {"shift_m": float(np.ravel(scene["z_offset"])[0]),
            "grazing_shift_m": float(np.ravel(scene["z_slope_scale"])[0])}


def filament(look_up, group, info):
    """Filament: points are moved along their normal, and the matrix of the look-up towards the light."""
    matrices, _ = look_up.member("FrameUniforms", "lightFromWorldMatrix")
    bias, bias_name = look_up.member("FrameUniforms", "shadowBias")
    if matrices is None or bias is None:
        return None
    text = look_up.text(rd.ShaderStage.Pixel) + look_up.text(rd.ShaderStage.Vertex)
    result = {"engine": "Filament", "notes": []}
    places = [number_of(matrices, entry, info) for entry in group]
    if None not in places and "frameUniforms.%s.y" % bias_name in text:
        amount = float(bias.ravel()[1])
        moved = [metres_towards_light(entry, matrices[place]) for entry, place in zip(group, places)]
        constant = moved[0] if None not in moved and np.ptp(moved) <= 1e-3 * (1e-3 + abs(moved[0])) else None
        result["bias"] = {"slope": 0, "normal": amount, "units": "metres, metres, metres", "normal_by": "sine"}
        if constant is not None:
            result["bias"]["constant"] = constant
    elif len(group) == 1:
        # Names of this block are shortened in all shaders: its matrices and amounts are known by how they are used.
        used = re.search(r"shadowUniforms\.(\w+)\[(\w+)\] \* vec4\([^;]*shadowUniforms\.(\w+)\[\2\]\.w", text)
        members = look_up.blocks.get("ShadowUniforms", {})
        if used is None or not {used[1], used[3]} <= set(members):
            return result
        place = number_of(members[used[1]], group[0], info)
        if place is None:
            return result
        result["bias"] = {"slope": 0, "normal": float(members[used[3]][place].ravel()[3]),
                          "units": "metres, metres, metres", "normal_by": "sine"}
        constant = metres_towards_light(group[0], members[used[1]][place])
        if constant is not None:
            result["bias"]["constant"] = constant
    splits, _ = look_up.member("FrameUniforms", "cascadeSplits")
    if splits is None or len(group) < 2 or sorted(p for p in places if p is not None) != list(range(len(group))):
        return result
    # Splits are places on the axis that points against the view.
    ends = [-float(v) for v in splits.ravel()[:len(group)]]
    far, _ = look_up.member("FrameUniforms", "cameraFar")
    # What lies beyond all splits reads the last map.
    ends[-1] = max(abs(float(far[0])) if far is not None else 0.0, 2 * ends[-2])
    starts = [0.0] + ends[:-1]
    if all(a < b for a, b in zip(starts, ends)):
        result["order"] = places
        result["intervals"] = [[starts[p], ends[p]] for p in places]
    return result


def own_program(look_up, group, info):
    """This program's own frames: settings are members of one block, or texels of one buffer."""
    values = {name: setting_of(look_up, name) for name in ("bias_constant", "bias_slope", "bias_normal")}
    units = {look_up.defines.get("bias_unit_" + name): name for name in ("depth", "texels", "metres")}
    unit = units.get(look_up.defines.get("bias_unit"))
    if unit is None or None in values.values():
        return None
    text = "".join(look_up.text(rd.ShaderStage.Pixel).split())
    result = {"engine": "Shadow Inspector", "notes": [], "bias": {"units": "%s, %s, texels" % (unit, unit)}}
    if "returnunit_depth(b,bias_constant);" in text:
        result["bias"].update(constant=values["bias_constant"], slope=0)
    elif "returnunit_depth(b,max(bias_slope*(1.0-clamp(b.n_dot_l,0.0,1.0)),bias_constant));" in text:
        result["bias"].update(constant=values["bias_constant"], slope=values["bias_slope"])
    offset_unit, by = own_offset(look_up, text)
    if by is not None:
        result["bias"].update(normal=values["bias_normal"], units="%s, %s, %s" % (unit, unit, offset_unit))
        if by != "length":
            result["bias"]["normal_by"] = by
    return result


def own_offset(look_up, text):
    """Returns unit and dependence on the angle of this program's normal offset; None for one that is unknown."""
    if "returnnormal*(bias_normal*texel_m);" in text:
        return "texels", "length"  # versions without these settings
    defines = look_up.defines
    names = ("length", "sine", "one-minus-cosine", "sideways")
    ways = {defines.get("bias_normal_by_" + name.replace("-", "_")): name for name in names}
    units = {defines.get("bias_normal_unit_" + name): name for name in ("texels", "metres")}
    ways.pop(None, None), units.pop(None, None)
    return units.get(defines.get("bias_normal_unit"), "texels"), ways.get(defines.get("bias_normal_by"))


def setting_of(look_up, name):
    """Returns a setting of this program, or None."""
    members = look_up.blocks.get("SettingsUniforms", {})
    if name in members:
        return float(np.ravel(members[name])[0])
    place = re.fullmatch(r"uintBitsToFloat\(settings_number\((\d+)\)\)", look_up.defines.get(name, ""))
    if place is None:
        return None
    if look_up.settings is None:
        look_up.settings = np.frombuffer(look_up.buffer_bytes("settings_texels"), "<f4")
    return shortest(look_up.settings[int(place[1])]) if int(place[1]) < len(look_up.settings) else None


TABLE = (godot, filament, own_program)


def known(capture, event, group, info):
    """Returns what a known engine's shader does at a draw that reads the maps of a light, or an empty dictionary."""
    if capture.vulkan:
        return {}  # SPIR-V has no names that can be relied on
    look_up = LookUp(capture, event)
    for engine in TABLE:
        try:
            result = engine(look_up, group, info)
        except (AttributeError, IndexError, KeyError, TypeError, ValueError, np.linalg.LinAlgError):
            continue  # the names with other types are another engine's
        if result is not None:
            return result
    return {}
