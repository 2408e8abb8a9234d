"""Draws, states, buffers and textures of a RenderDoc capture, read by replay.

Differences between OpenGL and Vulkan end in this file.
"""
import numpy as np
import renderdoc as rd

from capture_shader import live_text


class CaptureError(Exception):
    """One sentence for the user."""


REVERSED_FUNCTIONS = ("Greater", "GreaterEqual")
MAX_CONSTANT_BYTES = 16384


class State:
    """Raster state of one draw, as in OpenGL."""

    def __init__(self):
        self.cull = "none"
        self.front_ccw = True
        self.factor = 0.0
        self.units = 0.0
        self.unit_steps = 1  # steps of a format without floats that the driver takes for a unit of offset
        self.clamp = 0.0
        self.depth_clamp = False
        self.function = "Less"
        self.writes = True
        self.negative_one = False
        self.viewport = (0, 0, 1, 1)
        self.flipped = False  # the first row of the target shows clip y = +1
        self.depth_range = (0.0, 1.0)


class Draw:
    """One draw with its inputs and positions after the vertex shader."""

    def __init__(self):
        self.event = 0
        self.indices = None   # vertex of each corner, triangle list
        self.attributes = {}  # name: (vertex, component) float64 array
        self.locations = {}   # name: number of the input
        self.clips = []       # one (corner, 4) array an instance
        self.state = State()
        self.slice = 0
        self.vertex_shader = 0
        self.pixel_shader = 0
        self.discards = False
        self.constants = []   # (name, bytes)
        self.instance_constants = []  # of each instance
        self.pixel_constants = []
        self.textures = []    # resource ids that the pixel shader reads
        self.geometry = ()
        self.world = None
        self.posed = []       # world positions of the corners of each instance, where others than clips tell them
        self.position = None  # name of the position attribute


def texture_kind(fmt):
    """Returns "depth", "colour" for formats that may hold depths, else None."""
    name = fmt.Name()
    if name.startswith("D") and name[1:2].isdigit():
        return "depth"
    if fmt.compType == rd.CompType.Depth:
        return "depth"
    if fmt.compType == rd.CompType.Float and fmt.compByteWidth in (2, 4) and fmt.compCount in (1, 2, 4):
        return "colour"
    return None


def triangle_corners(topology, count):
    """Returns the corners of a list of triangles as places in the index list. None for lines and points."""
    name = topology.name
    if name == "TriangleList":
        return np.arange(count - count % 3)
    if name == "TriangleStrip":
        i = np.arange(max(count - 2, 0))
        odd = i % 2 == 1
        return np.stack([i, np.where(odd, i + 2, i + 1), np.where(odd, i + 1, i + 2)], 1).ravel()
    if name == "TriangleFan":
        i = np.arange(max(count - 2, 0))
        return np.stack([np.zeros_like(i), i + 1, i + 2], 1).ravel()
    return None


def block_members(block):
    """Returns the members of a block of constants, also where it has an instance name."""
    members = block.variables
    if len(members) == 1 and members[0].name == block.name:
        return members[0].type.members
    return members


class Capture:
    """An opened capture."""

    def __init__(self, path):
        rd.InitialiseReplay(rd.GlobalEnvironment(), [])
        self.file = rd.OpenCaptureFile()
        status = self.file.OpenFile(path, "", None)
        if status.code != rd.ResultCode.Succeeded:
            raise CaptureError("is no whole RenderDoc capture (%s); capture the frame again" % status.Message())
        driver = self.file.DriverName()
        if driver not in ("OpenGL", "OpenGL ES", "OpenGLES", "Vulkan"):
            raise CaptureError("was captured from %s; only captures from OpenGL and Vulkan can be opened" % driver)
        if self.file.LocalReplaySupport() != rd.ReplaySupport.Supported:
            raise CaptureError("cannot be replayed on this machine; its driver lacks what the capture needs")
        status, self.control = self.file.OpenCapture(rd.ReplayOptions(), None)
        if status.code != rd.ResultCode.Succeeded:
            raise CaptureError("cannot be replayed (%s); capture the frame again" % status.Message())
        self.vulkan = self.control.GetAPIProperties().pipelineType == rd.GraphicsAPI.Vulkan
        self.driver = driver
        self.structured = self.control.GetStructuredFile()
        self.textures = {int(t.resourceId): t for t in self.control.GetTextures()}
        self.actions = []
        self._walk(self.control.GetRootActions())
        self.by_event = {a.eventId: a for a in self.actions}
        self.buffers = {}
        self.geometries = {}
        self.unit_steps = 1

    def close(self):
        self.control.Shutdown()
        self.file.Shutdown()

    def _walk(self, actions):
        for action in actions:
            self.actions.append(action)
            self._walk(action.children)

    def usage(self, texture):
        return self.control.GetUsage(self.textures[texture].resourceId)

    def is_draw(self, event):
        action = self.by_event.get(event)
        return action is not None and bool(action.flags & rd.ActionFlags.Drawcall) and action.numIndices > 0

    def go(self, event):
        self.control.SetFrameEvent(event, False)

    # Textures

    def texels(self, texture, mip=0, slice_=0):
        """Returns a (row, column, channel) float64 array of a texture after the current event."""
        info = self.textures[texture]
        data = bytes(self.control.GetTextureData(info.resourceId, rd.Subresource(mip, slice_, 0)))
        width, height = max(1, info.width >> mip), max(1, info.height >> mip)
        fmt = info.format
        name = fmt.Name()
        count = width * height

        def need(bytes_per_texel):
            if len(data) < count * bytes_per_texel:
                raise CaptureError("texture %d is cut off in the capture" % texture)

        if name == "D16" or name.startswith("D16"):
            need(2)
            return (np.frombuffer(data, "<u2", count) / 65535.0).reshape(height, width, 1)
        if name.startswith("D24"):
            need(4)
            raw = np.frombuffer(data, "<u4", count)
            raw = raw & 0xFFFFFF if self.vulkan else raw >> 8
            return (raw / 16777215.0).reshape(height, width, 1)
        if name.startswith("D32S8"):
            need(8)
            return np.frombuffer(data, "<f4", count * 2).reshape(height, width, 2)[:, :, :1].astype(float)
        if name.startswith("D32"):
            need(4)
            values = np.frombuffer(data, "<f4", count)
            # A depth buffer of the window may hold 32-bit integers under this name.
            if not (np.isfinite(values).all() and values.min() >= -1e-6 and values.max() <= 1.000001):
                values = np.frombuffer(data, "<u4", count) / 4294967295.0
            return values.reshape(height, width, 1).astype(float)
        channels = fmt.compCount
        kind = {(rd.CompType.Float, 4): "<f4", (rd.CompType.Float, 2): "<f2"}.get((fmt.compType, fmt.compByteWidth))
        if kind:
            need(channels * fmt.compByteWidth)
            return np.frombuffer(data, kind, count * channels).reshape(height, width, channels).astype(float)
        if fmt.compByteWidth == 1 and channels in (1, 2, 3, 4):
            need(channels)
            values = np.frombuffer(data, "u1", count * channels).reshape(height, width, channels) / 255.0
            return values[:, :, [2, 1, 0] + list(range(3, channels))] if fmt.BGRAOrder() and channels >= 3 else values
        return None

    # Draws

    def viewport(self, state):
        view = state.GetViewport(0)
        y, height = view.y, view.height
        flipped = height < 0
        if flipped:
            y, height = y + height, -height
        return (view.x, y, view.width, height), flipped, (view.minDepth, view.maxDepth)

    def state(self, pipe):
        """Returns the raster state and the slice of the depth target at the current event."""
        state = State()
        state.viewport, state.flipped, state.depth_range = self.viewport(pipe)
        slice_ = 0
        if self.vulkan:
            vk = self.control.GetVulkanPipelineState()
            raster = vk.rasterizer
            state.cull = raster.cullMode.name
            # Vulkan measures the area with y down and the opposite sign.
            state.front_ccw = not raster.frontCCW
            if raster.depthBiasEnable:
                state.factor, state.units, state.clamp = \
                    raster.slopeScaledDepthBias, raster.depthBias, raster.depthBiasClamp
            state.depth_clamp = raster.depthClampEnable
            state.function = vk.depthStencil.depthFunction.name if vk.depthStencil.depthTestEnable else "AlwaysTrue"
            state.writes = vk.depthStencil.depthWriteEnable
            state.negative_one = vk.viewportScissor.depthNegativeOneToOne
            for attachment in vk.currentPass.framebuffer.attachments:
                texture = self.textures.get(int(attachment.imageResourceId))
                if texture is not None and texture_kind(texture.format) == "depth":
                    slice_ = attachment.firstSlice
        else:
            gl = self.control.GetGLPipelineState()
            raster = gl.rasterizer.state
            state.cull = raster.cullMode.name
            state.front_ccw = raster.frontCCW
            state.factor, state.units, state.clamp = raster.slopeScaledDepthBias, raster.depthBias, raster.offsetClamp
            state.depth_clamp = raster.depthClamp
            state.function = gl.depthState.depthFunction.name if gl.depthState.depthEnable else "AlwaysTrue"
            state.writes = gl.depthState.depthWrites
            state.negative_one = gl.vertexProcessing.clipNegativeOneToOne
            if not gl.vertexProcessing.clipOriginLowerLeft:
                state.flipped = not state.flipped
            slice_ = gl.framebuffer.drawFBO.depthAttachment.slice
            if not int(gl.framebuffer.drawFBO.depthAttachment.resourceId):
                slice_ = 0
        state.cull = {"NoCull": "none", "Back": "back", "Front": "front"}.get(state.cull, "both")
        if state.flipped:
            state.front_ccw = not state.front_ccw
        return state, slice_

    def colour_slice(self, texture):
        """Returns the slice of a colour target at the current event."""
        if self.vulkan:
            for attachment in self.control.GetVulkanPipelineState().currentPass.framebuffer.attachments:
                if int(attachment.imageResourceId) == texture:
                    return attachment.firstSlice
            return 0
        for attachment in self.control.GetGLPipelineState().framebuffer.drawFBO.colorAttachments:
            if int(attachment.resourceId) == texture:
                return attachment.slice
        return 0

    def bytes_of(self, resource, offset=0, length=0):
        return bytes(self.control.GetBufferData(resource, offset, length))

    def buffer(self, resource):
        """Returns all bytes of a vertex or index buffer at the current event; kept for static buffers."""
        key = int(resource)
        if key not in self.buffers:
            writes = [u for u in self.control.GetUsage(resource)
                      if u.usage.name in ("CPUWrite", "CopyDst", "Discard", "VS_RWResource", "CS_RWResource")]
            data = self.bytes_of(resource)
            if writes:
                return data
            self.buffers[key] = data
        return self.buffers[key]

    def attribute(self, attribute, buffers, vertices):
        """Returns a (vertex, component) array of one input, or None."""
        fmt = attribute.format
        if attribute.perInstance or attribute.genericEnabled or attribute.vertexBuffer >= len(buffers):
            return None
        bound = buffers[attribute.vertexBuffer]
        if not int(bound.resourceId):
            return None
        kind = {("Float", 4): "<f4", ("Float", 2): "<f2", ("Float", 8): "<f8", ("UNorm", 1): "u1", ("UNorm", 2): "<u2",
                ("SNorm", 1): "i1", ("SNorm", 2): "<i2", ("SScaled", 2): "<i2", ("UScaled", 2): "<u2"}.get(
                    (fmt.compType.name, fmt.compByteWidth))
        if kind is None or len(vertices) == 0 or fmt.Special():
            return None
        size = np.dtype(kind).itemsize * fmt.compCount
        stride = bound.byteStride
        data = self.buffer(bound.resourceId)
        start = bound.byteOffset + attribute.byteOffset
        at = start + vertices.astype(np.int64) * stride
        if at.max() + size > len(data) or at.min() < 0:
            return None
        raw = np.frombuffer(data, "u1")
        values = raw[at[:, None] + np.arange(size)].copy().view(kind).astype(float)
        scale = {("UNorm", 1): 255.0, ("UNorm", 2): 65535.0, ("SNorm", 1): 127.0, ("SNorm", 2): 32767.0}.get(
            (fmt.compType.name, fmt.compByteWidth))
        return values / scale if scale else values

    def post_vertex(self, instance, corners):
        """Returns the clip positions of the corners of one instance, or None."""
        mesh = self.control.GetPostVSData(instance, 0, rd.MeshDataStage.VSOut)
        if not int(mesh.vertexResourceId) or mesh.numIndices == 0:
            return None
        if int(mesh.indexResourceId) and mesh.indexByteStride:
            kind = {1: "u1", 2: "<u2", 4: "<u4"}[mesh.indexByteStride]
            raw = self.bytes_of(mesh.indexResourceId, mesh.indexByteOffset, mesh.numIndices * mesh.indexByteStride)
            index = np.frombuffer(raw, kind).astype(np.int64) + mesh.baseVertex
        else:
            index = np.arange(mesh.numIndices)
        if len(corners) == 0 or corners.max() >= len(index):
            return None
        index = index[corners]
        data = self.bytes_of(mesh.vertexResourceId, mesh.vertexByteOffset, 0)
        at = index * mesh.vertexByteStride
        if at.min() < 0 or at.max() + 16 > len(data):
            return None
        raw = np.frombuffer(data, "u1")
        return raw[at[:, None] + np.arange(16)].copy().view("<f4").astype(float)

    def constants(self, pipe, stage):
        """Returns (key, bytes) of all constants of a stage; matrices of plain uniforms get 64 bytes each."""
        result = []
        reflection = pipe.GetShaderReflection(stage)
        if reflection is None:
            return result
        mapping = pipe.GetBindpointMapping(stage)
        for slot, block in enumerate(reflection.constantBlocks):
            place = mapping.constantBlocks[block.bindPoint]
            for element in range(min(8, max(1, place.arraySize))):
                bound = pipe.GetConstantBuffer(stage, slot, element)
                if block.bufferBacked and not int(bound.resourceId):
                    break
                if block.bufferBacked:
                    size = bound.byteSize or block.byteSize
                    size = min(size, MAX_CONSTANT_BYTES) if size < 1 << 40 else block.byteSize
                    data = self.bytes_of(bound.resourceId, bound.byteOffset, size)
                    name = "" if self.vulkan else block.name
                    result.append(((stage.name, name, place.bindset, place.bind, element), data))
                else:
                    pipeline = pipe.GetGraphicsPipelineObject()
                    values = self.control.GetCBufferVariableContents(
                        pipeline, reflection.resourceId, stage, pipe.GetShaderEntryPoint(stage), slot,
                        bound.resourceId, bound.byteOffset, bound.byteSize)
                    for variable in values:
                        self._flatten((stage.name, variable.name), variable, result)
                    break
        return result

    def instance_constants(self, pipe, buffers, action, instance):
        """Returns (key, bytes) of the vertex buffers that step by instances."""
        result, spans = [], {}
        for attribute in pipe.GetVertexInputs():
            if attribute.used and attribute.perInstance and attribute.instanceRate > 0 and \
                    attribute.vertexBuffer < len(buffers) and attribute.format.compType == rd.CompType.Float and \
                    attribute.format.compByteWidth == 4:
                # In OpenGL rows of one matrix count as buffers of their own.
                bound = buffers[attribute.vertexBuffer]
                start = bound.byteOffset + attribute.byteOffset
                key = (int(bound.resourceId), bound.byteStride, attribute.instanceRate)
                spans.setdefault(key, []).append((start, start + 4 * attribute.format.compCount, bound.resourceId))
        for number, ((_, stride, rate), parts) in enumerate(sorted(spans.items())):
            data = self.buffer(parts[0][2])
            first, last = min(p[0] for p in parts), max(p[1] for p in parts)
            start = (action.instanceOffset + instance // rate) * stride
            result.append((("instance", number), data[start + first:start + last]))
        return result

    def storage_buffer(self, place):
        """Returns the storage buffer at a place of the current event and its first byte, or 0, 0."""
        try:
            if self.vulkan:
                sets = self.control.GetVulkanPipelineState().graphics.descriptorSets
                bound = sets[place.bindset].bindings[place.bind].binds[0]
                return bound.resourceResourceId, bound.byteOffset
            bound = self.control.GetGLPipelineState().shaderStorageBuffers[place.bind]
            return bound.resourceId, bound.byteOffset
        except IndexError:
            return 0, 0

    def storage_constants(self, pipe, action, count):
        """Returns, for each instance, (key, bytes) of its elements of arrays in the vertex shader's storage buffers."""
        result = [[] for _ in range(count)]
        stage = rd.ShaderStage.Vertex
        reflection = pipe.GetShaderReflection(stage)
        if reflection is None or count == 0:
            return result
        mapping = pipe.GetBindpointMapping(stage).readWriteResources
        pushed = self.pushed_numbers(pipe, stage, reflection) if len(reflection.readWriteResources) else []
        for resource in reflection.readWriteResources:
            place = mapping[resource.bindPoint]
            if resource.isTexture or not place.used:
                continue
            buffer, offset = self.storage_buffer(place)
            if not int(buffer):
                continue
            for member in resource.variableType.members:
                stride = member.type.arrayByteStride
                if member.type.elements < 2 or not 48 <= stride <= MAX_CONSTANT_BYTES:
                    continue
                start = offset + member.byteOffset
                key = ("storage", place.bindset, place.bind, member.byteOffset)
                data = self.bytes_of(buffer, start + action.instanceOffset * stride, count * stride)
                for i in range(min(count, len(data) // stride)):
                    result[i].append((key, data[i * stride:(i + 1) * stride]))
                for name, number in pushed:
                    data = self.bytes_of(buffer, start + number * stride, stride)
                    if len(data) == stride:
                        for constants in result:
                            constants.append((key + (name,), data))
        return result

    def pushed_numbers(self, pipe, stage, reflection):
        """Returns (name, value) of whole numbers outside of buffers, by which draws may choose elements of arrays."""
        result = []
        for slot, block in enumerate(reflection.constantBlocks):
            if block.bufferBacked or not self.vulkan:
                continue
            values = self.control.GetCBufferVariableContents(
                pipe.GetGraphicsPipelineObject(), reflection.resourceId, stage, pipe.GetShaderEntryPoint(stage), slot,
                rd.ResourceId.Null(), 0, 0)
            for block_value in values:
                for value in block_value.members if len(block_value.members) else [block_value]:
                    if value.type in (rd.VarType.UInt, rd.VarType.SInt) and value.rows * value.columns == 1 and \
                            value.value.u32v[0] < 1 << 24:
                        result.append((value.name, value.value.u32v[0]))
        return result

    def _flatten(self, key, variable, result):
        if len(variable.members):
            for member in variable.members:
                self._flatten(key + (member.name,), member, result)
        elif variable.type == rd.VarType.Float and variable.rows * variable.columns in (12, 16):
            values = np.array(variable.value.f32v[:variable.rows * variable.columns], "<f4")
            result.append((key, values.tobytes()))
        elif variable.type == rd.VarType.Float:
            values = np.array(variable.value.f32v[:max(1, variable.rows * variable.columns)], "<f4")
            result.append((key, values.tobytes()))

    def draw(self, event, fit=True):
        """Reads one draw. None where it draws no triangles or has no readable positions."""
        action = self.by_event[event]
        self.go(event)
        pipe = self.control.GetPipelineState()
        result = Draw()
        result.event = event
        result.state, result.slice = self.state(pipe)
        corners = triangle_corners(pipe.GetPrimitiveTopology(), action.numIndices)
        if corners is None or len(corners) == 0:
            return None
        bound = pipe.GetIBuffer()
        if action.flags & rd.ActionFlags.Indexed:
            kind = {1: "u1", 2: "<u2", 4: "<u4"}.get(bound.byteStride)
            if kind is None:
                return None
            data = self.buffer(bound.resourceId)
            start = bound.byteOffset + action.indexOffset * bound.byteStride
            if start + action.numIndices * bound.byteStride > len(data):
                return None
            index = np.frombuffer(data, kind, action.numIndices, start).astype(np.int64)
            keep = self._without_restart(index, bound.byteStride, pipe, corners)
            corners = corners if keep is None else keep
            index = index[corners] + action.baseVertex
        else:
            index = corners + action.vertexOffset
        if len(corners) == 0:
            return None
        vertices, result.indices = np.unique(index, return_inverse=True)
        buffers = pipe.GetVBuffers()
        for number, attribute in enumerate(pipe.GetVertexInputs()):
            if not attribute.used:
                continue
            name = attribute.name or "attribute %d" % number
            values = self.attribute(attribute, buffers, vertices)
            if values is None:
                continue
            result.attributes[name] = values
            result.locations[name] = attribute.vertexBuffer  # in OpenGL the number of the input
        for instance in range(max(1, action.numInstances)):
            clip = self.post_vertex(instance, corners)
            if clip is None:
                break
            result.clips.append(clip)
        vertex, pixel = rd.ShaderStage.Vertex, rd.ShaderStage.Pixel
        reflection = pipe.GetShaderReflection(vertex)
        result.vertex_shader = int(reflection.resourceId) if reflection else 0
        result.constants = self.constants(pipe, vertex)
        stored = self.storage_constants(pipe, action, len(result.clips))
        result.instance_constants = [self.instance_constants(pipe, buffers, action, i) + stored[i]
                                     for i in range(len(result.clips))]
        reflection = pipe.GetShaderReflection(pixel)
        if reflection:
            result.pixel_shader = int(reflection.resourceId)
            result.discards = self.discards(pipe, reflection)
            seen = []
            mapping = pipe.GetBindpointMapping(pixel)
            wanted = {b.bind for b in mapping.readOnlyResources if b.used} if not self.vulkan else None
            for array in pipe.GetReadOnlyResources(pixel):
                if wanted is not None and array.bindPoint.bind not in wanted:
                    continue
                for resource in array.resources:
                    if int(resource.resourceId) and int(resource.resourceId) not in seen:
                        seen.append(int(resource.resourceId))
            result.textures = seen
            # An ubershader has the word in code that is compiled out: without a texture no mask is read.
            result.discards = result.discards and bool(seen)
            if result.discards:
                result.pixel_constants = self.constants(pipe, pixel)
        return result

    def _without_restart(self, index, stride, pipe, corners):
        """Drops triangles that touch the restart index of a strip."""
        restart = (1 << (8 * stride)) - 1
        if stride == 4 or not (index == restart).any() or not pipe.IsStripRestartEnabled():
            return None
        bad = (index[corners].reshape(-1, 3) == restart).any(1)
        return corners.reshape(-1, 3)[~bad].ravel()

    def shader_text(self, pipe, reflection):
        if reflection.encoding == rd.ShaderEncoding.GLSL:
            return bytes(reflection.rawBytes).decode("utf-8", "replace")
        return self.control.DisassembleShader(pipe.GetGraphicsPipelineObject(), reflection, "")

    def member_offsets(self, block):
        """Returns {name: offset} of the members of a block, by all shaders of the capture that have it."""
        key = ("members", block)
        if key not in self.geometries:
            result = {}
            for resource in self.control.GetResources():
                if resource.type != rd.ResourceType.Shader:
                    continue
                for entry in self.control.GetShaderEntryPoints(resource.resourceId):
                    reflection = self.control.GetShader(rd.ResourceId.Null(), resource.resourceId, entry)
                    for found in reflection.constantBlocks if reflection else []:
                        if found.name == block:
                            for member in block_members(found):
                                result.setdefault(member.name, member.byteOffset)
            self.geometries[key] = result
        return self.geometries[key]

    def discards(self, pipe, reflection):
        """Returns whether a pixel shader may drop pixels."""
        key = ("discard", int(reflection.resourceId))
        if key not in self.geometries:
            text = self.shader_text(pipe, reflection)
            if reflection.encoding == rd.ShaderEncoding.GLSL:
                text = live_text(text)
            self.geometries[key] = "discard" in text or "Kill" in text or "TerminateInvocation" in text
        return self.geometries[key]
