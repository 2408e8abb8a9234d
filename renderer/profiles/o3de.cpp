// Profile of O3DE.
#include <algorithm>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kO3deSource = "o3de/o3de 354a2acc: DirectionalLightShadowCalculator.azsli, Shadowmap.shader";
constexpr double kO3deHiddenSlope = 4;
constexpr double kO3deHiddenUnits = 10;

constexpr EngineParameter kO3deParameters[] = {
    {.key = "ShadowBias",
     .unit = "m",
     .standard = 0.0015,
     .min = 0,
     .max = 0.2,
     .meaning = "Shift of the receiver along the light's axis. It comes on top of a hidden polygon offset.",
     .source = kO3deSource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "NormalShadowBias",
     .unit = "2 m / texels across",
     .standard = 2.5,
     .min = 0,
     .max = 10,
     .meaning = "Shift of the look-up along the normal: this many times 2 m over the texels across the map. Not scaled "
                "by the width of the map.",
     .source = "o3de/o3de 354a2acc: NormalOffsetShadows.azsli",
     .setting = "bias.normal",
     .is_bias = true},
    {.key = "ShadowmapSize",
     .unit = "texels",
     .standard = 1024,
     .min = 256,
     .max = 2048,
     .meaning = "Texels across the map of a cascade.",
     .source = kO3deSource,
     .setting = "map.resolution",
     .scale = 1},
    {.key = "CascadeCount",
     .standard = 4,
     .min = 1,
     .max = 4,
     .meaning = "Number of cascades.",
     .source = kO3deSource,
     .setting = "light.cascades",
     .scale = 1},
    {.key = "SplitRatio",
     .standard = 0.9,
     .min = 0,
     .max = 1,
     .meaning = "Splits: 0 even, 1 logarithmic.",
     .source = kO3deSource,
     .setting = "light.split_lambda",
     .scale = 1},
};

constexpr ForcedSetting kO3deForced[] = {
    {"bias.raster_slope", "4", "O3DE draws its maps with depthBiasSlopeScale 4"},
    {"bias.raster_units", "10", "O3DE draws its maps with depthBias 10"},
};

constexpr std::string_view kO3deRows[] = {"constant", "normal-offset", "receiver-plane-derivatives"};

constexpr LackingSetting kO3deLacking[] = {
    {"bias.slope", "", "O3DE has no slope bias at the receiver"}, {"light.cascades", "5", "O3DE has up to 4 cascades"},
    {"light.cascades", "6", "O3DE has up to 4 cascades"},         {"light.cascades", "7", "O3DE has up to 4 cascades"},
    {"light.cascades", "8", "O3DE has up to 4 cascades"},
};

double hidden_o3de(const EngineProfile&, const EngineValues&, const MapFacts& facts) {
    return raster_equivalent(kO3deHiddenSlope, kO3deHiddenUnits, facts);
}

BiasNumbers read_o3de(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    out.constant_unit = BiasUnit::Metres;
    out.constant_texels = engine_value(profile, values, "ShadowBias") / facts.texel_m();
    out.normal_texels = 2 * engine_value(profile, values, "NormalShadowBias") / facts.width_m;
    out.normal_note = "for this width of the map";
    out.raster_slope = kO3deHiddenSlope;
    out.raster_units = kO3deHiddenUnits;
    return out;
}

void write_o3de(const BiasNumbers& bias, const EngineValues& values, const MapFacts& facts, EngineOutput& to) {
    const double per_texel = offset_equivalent(OffsetBy::Length, facts.angle_deg);
    const double left = std::max(0.0, bias.total_texels(facts) - hidden_o3de(o3de_profile(), values, facts));
    const double normal = std::min(bias.normal_texels, left / per_texel);
    const double constant = left - normal * per_texel;
    to.put("ShadowBias", constant * facts.texel_m(), Exactness::EqualAtAngle, constant,
           bias.constant_texels * facts.texel_m(), "what the hidden polygon offset leaves to give");
    to.put("NormalShadowBias", normal * facts.width_m / 2, Exactness::EqualAtAngle, normal * per_texel,
           bias.normal_texels * facts.width_m / 2, "for this width of the map alone");
}

}  // namespace

const EngineProfile& o3de_profile() {
    static const EngineProfile row{.name = "o3de",
                                   .title = "O3DE",
                                   .version = "4.2.0",
                                   .parameters = kO3deParameters,
                                   .forced = kO3deForced,
                                   .lacking = kO3deLacking,
                                   .bias_rows = kO3deRows,
                                   .hidden_texels = hidden_o3de,
                                   .read_bias = read_o3de,
                                   .write_bias = write_o3de};
    return row;
}

}  // namespace si
