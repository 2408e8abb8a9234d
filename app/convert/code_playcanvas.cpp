// Code template of PlayCanvas.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string playcanvas_code(const CodeInput& in) {
    const int shared = in.facts.cascades > 1 ? 2 : 1;  // 2 to 4 cascades share the map
    std::string out = in.line("entity.light.shadowBias = {};", "shadowBias");
    out += in.line("entity.light.normalOffsetBias = {};", "normalOffsetBias");
    out += fmt::format("entity.light.shadowResolution = {};\n", shared * in.facts.texels);
    out += in.line("entity.light.shadowType = pc.{};", "shadowType");
    out += fmt::format("entity.light.numCascades = {};\n", in.facts.cascades);
    out += in.line("entity.light.cascadeDistribution = {};", "cascadeDistribution");
    const LightSettings& light = in.light();
    return out + fmt::format("entity.setEulerAngles({}, {}, 0);\n", code_number(90 - light.elevation),
                             code_number(light.azimuth));
}

}  // namespace si
