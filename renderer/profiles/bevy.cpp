// Profile of Bevy.
#include <numbers>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kBevySource =
    "bevyengine/bevy 4805ca79: directional_light.rs, render/light.rs, shadows.wesl";

constexpr EngineChoice kBevyMethods[] = {
    {"Hardware2x2", "filter.kernel=hw2x2|filter.kernel=hard"},
    {"Gaussian",
     "filter.kernel=gauss filter.size=5|filter.kernel=tent|filter.kernel=tent3|filter.kernel=pcf|"
     "filter.kernel=gauss"},
    {"Temporal", "filter.kernel=vogel filter.taps=8|filter.kernel=vogel|filter.kernel=poisson"},
};

constexpr EngineParameter kBevyParameters[] = {
    {.key = "shadow_depth_bias",
     .unit = "m",
     .standard = 0.02,
     .min = 0,
     .max = 1e3,
     .meaning = "Shift of the receiver towards the light. It does not scale with cascades or resolution.",
     .source = kBevySource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "shadow_normal_bias",
     .unit = "diagonals of a texel",
     .standard = 1.8,
     .min = 0,
     .max = 1e3,
     .meaning = "Shift of the look-up along the normal, times the square root of 2.",
     .source = kBevySource,
     .setting = "bias.normal",
     .is_bias = true},
    {.key = "size",
     .unit = "texels",
     .standard = 2048,
     .min = 1,
     .max = 16384,
     .meaning = "Texels across the map of a cascade (DirectionalLightShadowMap).",
     .source = kBevySource,
     .setting = "map.resolution",
     .scale = 1},
    {.key = "ShadowFilteringMethod",
     .standard = 1,
     .min = 0,
     .max = 2,
     .meaning = "Filter.",
     .source = kBevySource,
     .setting = "filter.kernel",
     .choices = kBevyMethods},
    {.key = "num_cascades",
     .standard = 4,
     .min = 1,
     .max = 8,
     .meaning = "Number of cascades.",
     .source = kBevySource,
     .setting = "light.cascades",
     .scale = 1},
    {.key = "overlap_proportion",
     .standard = 0.1,
     .min = 0,
     .max = 0.99,
     .meaning = "Share of a cascade's depth over which the next one blends in.",
     .source = kBevySource,
     .setting = "light.cascade_blend",
     .scale = 1},
};

constexpr ForcedSetting kBevyForced[] = {
    {"map.reversed_z", "true", "Bevy stores reversed depth"},
};

constexpr LackingSetting kBevyLacking[] = {
    {"bias.slope", "", "Bevy has no slope bias"},
    {"bias.raster_slope", "", "Bevy draws its maps without polygon offset"},
    {"bias.raster_units", "", "Bevy draws its maps without polygon offset"},
};

BiasNumbers read_bevy(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    out.constant_unit = BiasUnit::Metres;
    out.constant_texels = engine_value(profile, values, "shadow_depth_bias") / facts.texel_m();
    out.normal_texels = engine_value(profile, values, "shadow_normal_bias") * std::numbers::sqrt2;
    return out;
}

void write_bevy(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    const double raster = bias.raster_texels(facts);
    to.put("shadow_depth_bias", (bias.constant_texels + raster) * facts.texel_m(),
           raster == 0 ? bias.constant : Exactness::EqualAtAngle, bias.constant_texels + raster,
           bias.constant_texels * facts.texel_m(), bias.constant_note);
    to.put_length_offset("shadow_normal_bias", bias.normal_texels / std::numbers::sqrt2, bias);
}

}  // namespace

const EngineProfile& bevy_profile() {
    static const EngineProfile row{.name = "bevy",
                                   .title = "Bevy",
                                   .version = "0.20.0-dev, August 2026",
                                   .parameters = kBevyParameters,
                                   .forced = kBevyForced,
                                   .lacking = kBevyLacking,
                                   .bias_rows = kConstantAndNormal,
                                   .read_bias = read_bevy,
                                   .write_bias = write_bevy};
    return row;
}

}  // namespace si
