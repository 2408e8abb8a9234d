// Profiles of Filament: the present version and 1.9.
#include <algorithm>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kFilamentSource = "google/filament: ShadowMap.cpp, LightManager.h, surface_shadowing.glsl";
constexpr int kFilamentRim = 2;             ///< texels of the map that are not used
constexpr double kFilamentHalfTexel = 0.5;  ///< of normalBias

constexpr EngineChoice kFilamentTypes[] = {
    {"PCF",
     "filter.kernel=tent filter.size=3|filter.kernel=tent3|filter.kernel=pcf|filter.kernel=hw2x2|"
     "filter.kernel=tent|filter.kernel=gauss|filter.kernel=vogel|filter.kernel=poisson"},
    {"VSM", "filter.kernel=evsm2|filter.kernel=vsm|filter.kernel=evsm4"},
    {"DPCF", "filter.kernel=dpcf"},
    {"PCSS", "filter.kernel=pcss"},
};

constexpr EngineParameter kFilamentParameters[] = {
    {.key = "constantBias",
     .unit = "m",
     .standard = 0.001,
     .min = 0,
     .max = 2,
     .meaning = "Shift of casters away from the light. Not under VSM.",
     .source = kFilamentSource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "normalBias",
     .unit = "half texels",
     .standard = 1,
     .min = 0,
     .max = 3,
     .meaning = "Shift of the look-up along the normal, times the sine of the angle.",
     .source = kFilamentSource,
     .setting = "bias.normal",
     .is_bias = true},
    {.key = "polygonOffsetSlope",
     .standard = 2,
     .min = -100,
     .max = 100,
     .meaning = "Polygon offset factor while the map is drawn. Not under VSM.",
     .source = kFilamentSource,
     .setting = "bias.raster_slope",
     .is_bias = true},
    {.key = "polygonOffsetConstant",
     .unit = "depth steps",
     .standard = 0.5,
     .min = -1e7,
     .max = 1e7,
     .meaning = "Polygon offset units while the map is drawn.",
     .source = kFilamentSource,
     .setting = "bias.raster_units",
     .is_bias = true},
    {.key = "mapSize",
     .unit = "texels",
     .standard = 1024,
     .min = 8,
     .max = 2048,
     .meaning = "Texels across the map, of which a rim of one texel is not used.",
     .source = kFilamentSource,
     .setting = "map.resolution",
     .scale = 1},
    {.key = "shadowType",
     .standard = 0,
     .min = 0,
     .max = 3,
     .meaning = "Filter, of the View.",
     .source = kFilamentSource,
     .setting = "filter.kernel",
     .choices = kFilamentTypes},
    {.key = "shadowCascades",
     .standard = 1,
     .min = 1,
     .max = 4,
     .meaning = "Number of cascades.",
     .source = kFilamentSource,
     .setting = "light.cascades",
     .scale = 1},
    {.key = "cascadeSplitPositions[0]",
     .standard = 0.125,
     .min = 0,
     .max = 1,
     .meaning = "Far end of the first cascade, as a share of the depth.",
     .source = kFilamentSource,
     .setting = "light.split_1",
     .scale = 1},
    {.key = "cascadeSplitPositions[1]",
     .standard = 0.25,
     .min = 0,
     .max = 1,
     .meaning = "Far end of the second cascade.",
     .source = kFilamentSource,
     .setting = "light.split_2",
     .scale = 1},
    {.key = "cascadeSplitPositions[2]",
     .standard = 0.5,
     .min = 0,
     .max = 1,
     .meaning = "Far end of the third cascade.",
     .source = kFilamentSource,
     .setting = "light.split_3",
     .scale = 1},
};

constexpr ForcedSetting kFilamentForced[] = {
    {"map.reversed_z", "true", "Filament stores reversed depth"},
};

constexpr std::string_view kFilamentRows[] = {"constant", "normal-offset", "raster"};

constexpr LackingSetting kFilamentLacking[] = {
    {"bias.slope", "", "Filament has no slope bias at the receiver"},
    {"light.cascades", "8", "Filament has up to 4 cascades"},
};

/// Returns the width of a used texel in texels of the map.
double used_texel(const MapFacts& facts) {
    return double(facts.texels) / (facts.texels - kFilamentRim);
}

double hidden_filament(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    // A number that was written counts as given; hidden is a default that nobody has changed.
    return values.contains("polygonOffsetSlope")
               ? 0
               : engine_value(profile, values, "polygonOffsetSlope") * tan_angle(facts);
}

BiasNumbers read_filament(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    // Both numbers count in used texels: a texel of this program's map stands for one.
    out.constant_texels = engine_value(profile, values, "constantBias") / facts.texel_m() / used_texel(facts);
    out.constant_unit = BiasUnit::Metres;
    out.normal_texels = kFilamentHalfTexel * engine_value(profile, values, "normalBias");
    out.normal_by = OffsetBy::Sine;
    out.raster_slope = engine_value(profile, values, "polygonOffsetSlope");
    out.raster_units = engine_value(profile, values, "polygonOffsetConstant");
    return out;
}

void write_filament(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    const EngineParameter& parameter = engine_parameter(filament_profile(), "normalBias");
    const double number = quotient(bias.normal_texels, kFilamentHalfTexel * sin_angle(facts));
    const double accepted = std::min(number, parameter.max);
    const double equivalent = bias.normal_texels * offset_equivalent(OffsetBy::Length, facts.angle_deg);
    const double given = accepted * kFilamentHalfTexel * tan_angle(facts);
    const double rest = std::max(0.0, equivalent - given);  // also at an angle of 0, where a sine gives nothing
    const bool moved = rest > 1e-9;
    const double to_metres = facts.texel_m() * used_texel(facts);
    to.put("constantBias", (bias.constant_texels + rest) * to_metres, moved ? Exactness::EqualAtAngle : bias.constant,
           bias.constant_texels + rest, bias.constant_texels * to_metres,
           moved ? "with the part of the normal offset beyond the range of normalBias" : bias.constant_note);
    to.put("normalBias", accepted,
           bias.normal_texels == 0 || (bias.settings_by == OffsetBy::Sine && !moved) ? Exactness::Exact
                                                                                     : Exactness::EqualAtAngle,
           given, number);
    to.put("polygonOffsetSlope", bias.raster_slope, Exactness::Exact, bias.raster_slope * tan_angle(facts),
           bias.raster_slope);
    to.put("polygonOffsetConstant", bias.raster_units, Exactness::Exact,
           bias.raster_texels(facts) - bias.raster_slope * tan_angle(facts), bias.raster_units);
    to.miss("bias.raster_clamp", bias.raster_clamp, "Filament has no clamp of the polygon offset");
    to.note("Filament fits width and depth range of the map by itself: W and D change with the camera");
}

}  // namespace

const EngineProfile& filament_profile() {
    static const EngineProfile row{.name = "filament",
                                   .title = "Filament",
                                   .version = "source of 2026",
                                   .unverified =
                                       "whether the half texel of normalBias still holds for directional "
                                       "lights; if not, halve normalBias",
                                   .parameters = kFilamentParameters,
                                   .forced = kFilamentForced,
                                   .lacking = kFilamentLacking,
                                   .bias_rows = kFilamentRows,
                                   .normal_by = OffsetBy::Sine,
                                   .hidden_texels = hidden_filament,
                                   .read_bias = read_filament,
                                   .write_bias = write_filament};
    return row;
}

const EngineProfile& filament19_profile() {
    static const EngineProfile row = [] {
        EngineProfile old = filament_profile();
        old.name = "filament19";
        old.title = "Filament 1.9";
        old.version = "1.9";
        old.unverified = "all of it: the formulas are those of the newer version, and no source of 1.9 was read";
        return old;
    }();
    return row;
}

}  // namespace si
