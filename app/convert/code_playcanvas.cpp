// Code template of PlayCanvas.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

std::string playcanvas_code(const CodeInput& in) {
    std::string out = in.line("entity.light.shadowBias = {};", "shadowBias");
    out += in.line("entity.light.normalOffsetBias = {};", "normalOffsetBias");
    out += in.line("entity.light.shadowResolution = {};", "shadowResolution");
    out += in.line("entity.light.shadowType = pc.{};", "shadowType");
    out += in.line("entity.light.numCascades = {};", "numCascades");
    out += in.line("entity.light.cascadeDistribution = {};", "cascadeDistribution");
    const LightSettings& light = in.light();
    return out + fmt::format("entity.setEulerAngles({}, {}, 0);\n", code_number(90 - light.elevation),
                             code_number(light.azimuth));
}

}  // namespace si
