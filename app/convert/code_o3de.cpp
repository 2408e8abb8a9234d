// Code template of O3DE.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string o3de_code(const CodeInput& in) {
    std::string out = "// Directional Light component:\n";
    out += fmt::format("config.m_shadowBias = {};\n", in.c_text("ShadowBias"));
    out += fmt::format("config.m_normalShadowBias = {};\n", in.c_text("NormalShadowBias"));
    out += in.line("// Shadowmap size {}", "ShadowmapSize") + in.line("// Cascade count {}", "CascadeCount");
    return out + in.line("// Split ratio {}", "SplitRatio");
}

}  // namespace si
