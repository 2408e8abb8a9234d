// Code template of Unity URP.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

namespace {

/// Returns the lines that both modes of the bias have.
std::string unity_light(const CodeInput& in, const char* mode) {
    std::string out = fmt::format("// Project Settings, Graphics, URP: depth bias mode {}\n", mode);
    out += "light.GetUniversalAdditionalLightData().usePipelineSettings = false;\n";
    out += in.line("light.shadowBias = {}f;", "shadowDepthBias") +
           in.line("light.shadowNormalBias = {}f;", "shadowNormalBias");
    const int shared = in.facts.cascades > 1 ? 2 : 1;  // 2 to 4 cascades share the map
    out += fmt::format("// URP asset: main light shadow resolution {}, cascade count {}\n", shared * in.facts.texels,
                       in.facts.cascades);
    return out + in.line("// Soft shadows of the light or the asset: {}", "softShadowQuality");
}

}  // namespace

std::string urp_code(const CodeInput& in) {
    return unity_light(in, "Depth Bias (Legacy)");
}

std::string urp_slope_code(const CodeInput& in) {
    return unity_light(in, "Slope-Scale");
}

}  // namespace si
