// Code template of WebGPU.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string webgpu_code(const CodeInput& in) {
    return fmt::format(
        "// member of the GPURenderPipelineDescriptor of the pass that draws the map\n"
        "const depthStencil = {{\n    depthBias: {},\n    depthBiasSlopeScale: {},\n    depthBiasClamp: {},\n}};\n"
        "// in the shader that reads the map\n"
        "const shaderDepthBias = {};      // normalised depth, towards the light\n"
        "const shaderNormalOffset = {};   // metres along the geometric normal\n",
        fmt::format("{:.0f}", in.number("depthBias")), in.text("depthBiasSlopeScale"), in.text("depthBiasClamp"),
        in.text("shader.depthBias"), in.text("shader.normalOffset"));
}

}  // namespace si
