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
     "filter.kernel=tent3 filter.bilinear=true|filter.kernel=tent filter.size=3|filter.kernel=tent3|"
     "filter.kernel=pcf|filter.kernel=hw2x2|filter.kernel=tent|filter.kernel=gauss|filter.kernel=vogel|filter.kernel="
     "poisson"},
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
    {"light.cascades", "5", "Filament has up to 4 cascades"},
    {"light.cascades", "6", "Filament has up to 4 cascades"},
    {"light.cascades", "7", "Filament has up to 4 cascades"},
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

constexpr std::string_view kFilament19Source =
    "google/filament 1.9: ShadowMap.cpp, ShadowMapManager.cpp (getShadowNormalBias(0)), LightManager.h; measured";

// The weights are (2 - distance) / 4 in texels.
constexpr EngineChoice kFilament19Types[] = {
    {"PCF",
     "filter.kernel=tent3 filter.bilinear=true|filter.kernel=gauss filter.size=3|"
     "filter.kernel=tent filter.size=3|filter.kernel=tent3|filter.kernel=pcf|"
     "filter.kernel=hw2x2|filter.kernel=tent|filter.kernel=gauss|filter.kernel=vogel|filter.kernel=poisson"},
    {"VSM", "filter.kernel=evsm2|filter.kernel=vsm|filter.kernel=evsm4"},
};

constexpr EngineChoice kFilament19Culling[] = {
    {"BACK", "caster.cull=back"}, {"FRONT", "caster.cull=front"}, {"NONE", "caster.cull=none"}};

/// Returns the parameters of 1.9: those of the newer version but for normalBias, filters and defaults.
std::vector<EngineParameter> filament19_parameters() {
    std::vector<EngineParameter> out(std::begin(kFilamentParameters), std::end(kFilamentParameters));
    for (EngineParameter& p : out) {
        p.source = kFilament19Source;
        if (p.key == "normalBias") {
            p.meaning = "Without effect for directional lights: Filament 1.9 always takes 1, in whole texels.";
            p.unit = "";
            p.setting = {};
            p.is_bias = false;
        }
        if (p.key == "shadowType") {
            p.choices = kFilament19Types;
            p.max = double(std::size(kFilament19Types) - 1);
        }
        constexpr double kSplits[] = {0.25, 0.5, 0.75};
        for (int i = 0; i < 3; ++i)
            if (p.key == kFilamentParameters[std::size(kFilamentParameters) - 3 + i].key) p.standard = kSplits[i];
    }
    out.push_back({.key = "culling",
                   .standard = 0,
                   .min = 0,
                   .max = 2,
                   .meaning = "Faces that a material culls, in the map as in the picture. Two-sided ones cull none.",
                   .source = "google/filament 1.9: MaterialBuilder.h; measured",
                   .setting = "caster.cull",
                   .choices = kFilament19Culling});
    return out;
}

constexpr ForcedSetting kFilament19Forced[] = {
    {"map.reversed_z", "true", "Filament stores reversed depth"},
    {"map.format", "d16", "Filament 1.9 has 16-bit maps"},
    {"bias.normal_unit", "texels", "Filament 1.9 shifts the look-up of directional lights by one texel"},
    {"bias.normal_by", "sine", "Filament 1.9 shifts by the sine of the angle"},
    {"bias.normal", "1", "Filament 1.9 shifts the look-up of directional lights by one texel"},
};

double hidden_filament19(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    return hidden_filament(profile, values, facts) + offset_equivalent(OffsetBy::Sine, facts.angle_deg);
}

BiasNumbers read_filament19(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out = read_filament(profile, values, facts);
    out.normal_texels = 1;
    out.format = MapFormat::D16;
    return out;
}

void write_filament19(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    const double hidden = offset_equivalent(OffsetBy::Sine, facts.angle_deg);
    const double left = std::max(0.0, bias.receiver_texels(facts) - hidden);
    // Settings as the profile draws them hold the hidden offset, and the constant stands beside it.
    const bool is_drawn = std::abs(left - bias.constant_texels) < 1e-9;
    const double to_metres = facts.texel_m() * used_texel(facts);
    to.put("constantBias", left * to_metres, is_drawn ? bias.constant : Exactness::EqualAtAngle, left,
           bias.constant_texels * to_metres,
           is_drawn ? bias.constant_note : "what the hidden normal offset leaves to give");
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
                                       "lights; if not, halve normalBias. Version 1.9 ignores normalBias, and newer "
                                       "source makes the same call",
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
    static const std::vector<EngineParameter> parameters = filament19_parameters();
    static const EngineProfile row = [] {
        EngineProfile old = filament_profile();
        old.name = "filament19";
        old.title = "Filament 1.9";
        old.version = "1.9.25";
        old.unverified = "VSM, LiSPSM, and cascades behind the first";
        old.parameters = parameters;
        old.forced = kFilament19Forced;
        old.hidden_texels = hidden_filament19;
        old.read_bias = read_filament19;
        old.write_bias = write_filament19;
        return old;
    }();
    return row;
}

}  // namespace si
