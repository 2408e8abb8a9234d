// Code template of Direct3D 12.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string d3d12_code(const CodeInput& in) {
    return fmt::format(
        "// D3D12_RASTERIZER_DESC of the pass that draws the map\n"
        "desc.DepthBias = {};\ndesc.SlopeScaledDepthBias = {};\ndesc.DepthBiasClamp = {};\n"
        "// in the shader that reads the map\n"
        "constexpr float shader_depth_bias = {};       // normalised depth, towards the light\n"
        "constexpr float shader_normal_offset_m = {};  // along the geometric normal\n",
        fmt::format("{:.0f}", in.number("DepthBias")), in.c_text("SlopeScaledDepthBias"), in.c_text("DepthBiasClamp"),
        in.c_text("shader.depthBias"), in.c_text("shader.normalOffset"));
}

}  // namespace si
