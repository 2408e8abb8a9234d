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
    out += in.line("// URP asset: main light shadow resolution {}", "mainLightShadowmapResolution");
    out += in.line("// URP asset: cascade count {}", "shadowCascadeCount");
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
