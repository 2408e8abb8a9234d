// Code template of Filament.
#include <fmt/format.h>

#include "app/convert/targets.h"

namespace si {

namespace {

std::string filament_options(const CodeInput& in, bool has_normal_bias) {
    std::string out = "LightManager::ShadowOptions options;\n";
    out += in.line("options.mapSize = {};", "mapSize");
    for (const std::string_view key : {"constantBias", "normalBias", "polygonOffsetConstant", "polygonOffsetSlope"})
        if (has_normal_bias || key != "normalBias") out += in.line(fmt::format("options.{} = {{}};", key), key);
    return out + in.line("options.shadowCascades = {};", "shadowCascades");
}

}  // namespace

std::string filament_code(const CodeInput& in) {
    std::string out = filament_options(in, true);
    for (const char* key : {"cascadeSplitPositions[0]", "cascadeSplitPositions[1]", "cascadeSplitPositions[2]"})
        out += in.line(fmt::format("options.{} = {{}};", key), key);
    const LightFit fit = in.light().fit;
    out += fmt::format("options.stable = {};\noptions.lispsm = {};\n", fit == LightFit::Stabilised,
                       fit == LightFit::Lispsm);
    out += in.line("view->setShadowType(View::ShadowType::{});", "shadowType");
    return out + "LightManager::Builder(LightManager::Type::SUN).castShadows(true).shadowOptions(options);\n";
}

std::string filament19_code(const CodeInput& in) {
    return filament_options(in, false) +
           "LightManager::Builder(LightManager::Type::SUN).castShadows(true).shadowOptions(options);\n";
}

}  // namespace si
