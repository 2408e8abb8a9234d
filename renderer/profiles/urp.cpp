// Profiles of Unity URP: its two modes of depth bias.
#include <algorithm>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kUrpSource =
    "Unity-Technologies/Graphics: ShadowUtils.cs (GetShadowBias, RenderShadowSlice), Shadows.hlsl (ApplyShadowBias)";
constexpr double kUrpHiddenSlope = 2.5;  ///< polygon offset factor while the legacy mode draws its map
constexpr double kUrpSlope = 5;          ///< polygon offset factor per depthBias in slope-scale mode
/// Factors of both biases, by softShadowQuality.
constexpr double kUrpRadii[] = {1, 1.5, 2.5, 3.5};

constexpr EngineChoice kUrpQualities[] = {
    {"Hard", "filter.kernel=hw2x2|filter.kernel=hard"},
    {"Low", "filter.kernel=pcf filter.size=2|filter.kernel=tent3"},
    {"Medium",
     "filter.kernel=tent filter.size=5|filter.kernel=pcf|filter.kernel=gauss filter.size=5|"
     "filter.kernel=vogel|filter.kernel=poisson"},
    {"High", "filter.kernel=tent filter.size=7|filter.kernel=tent|filter.kernel=gauss"},
};

constexpr EngineParameter kUrpResolution{
    .key = "mainLightShadowmapResolution",
    .unit = "texels",
    .standard = 2048,
    .min = 256,
    .max = 8192,
    .meaning = "Texels across the atlas. 2 to 4 cascades share it, with half the width each.",
    .source = kUrpSource,
    .setting = "map.resolution",
    .scale = 1};
constexpr EngineParameter kUrpQuality{
    .key = "softShadowQuality",
    .standard = 2,
    .min = 0,
    .max = 3,
    .meaning = "Filter: 4 bilinear taps, 5x5 tent or 7x7 tent. It multiplies both biases.",
    .source = kUrpSource,
    .setting = "filter.kernel",
    .choices = kUrpQualities};
constexpr EngineParameter kUrpCascades{.key = "shadowCascadeCount",
                                       .standard = 1,
                                       .min = 1,
                                       .max = 4,
                                       .meaning = "Number of cascades.",
                                       .source = kUrpSource,
                                       .setting = "light.cascades",
                                       .scale = 1};
constexpr EngineParameter kUrpNormal{
    .key = "shadowNormalBias",
    .unit = "texels x filter radius",
    .standard = 1,
    .min = 0,
    .max = 10,
    .meaning = "Shift of casters inwards along the normal, times 1 - cosine of the angle.",
    .source = kUrpSource,
    .setting = "bias.normal",
    .is_bias = true};

constexpr EngineParameter kUrpParameters[] = {
    {.key = "shadowDepthBias",
     .unit = "texels x filter radius",
     .standard = 1,
     .min = 0,
     .max = 10,
     .meaning = "Shift of casters away from the light. It comes on top of a hidden polygon offset.",
     .source = kUrpSource,
     .setting = "bias.constant",
     .is_bias = true},
    kUrpNormal,
    kUrpQuality,
    kUrpResolution,
    kUrpCascades};

constexpr EngineParameter kUrpSlopeParameters[] = {
    {.key = "shadowDepthBias",
     .unit = "polygon offset factor / 5 / filter radius",
     .standard = 1,
     .min = 0,
     .max = 1,
     .meaning = "Polygon offset factor while the map is drawn: five times this number times the filter's radius.",
     .source = "URPShadowBiasSettings, ShadowDepthBiasMode and their tests",
     .setting = "bias.raster_slope",
     .is_bias = true},
    kUrpNormal,
    kUrpQuality,
    kUrpResolution,
    kUrpCascades};

constexpr ForcedSetting kUrpForced[] = {
    {"bias.raster_slope", "2.5", "URP draws its maps with SetGlobalDepthBias(1.0, 2.5)"},
    {"bias.raster_units", "1", "URP draws its maps with SetGlobalDepthBias(1.0, 2.5)"},
};

constexpr LackingSetting kUrpLacking[] = {
    {"bias.slope", "", "URP has no slope bias at the receiver"},
    {"filter.kernel", "pcss", "URP has no contact hardening"},
    {"filter.kernel", "vsm", "URP has no moments"},
    {"light.cascades", "5", "URP has up to 4 cascades"},
    {"light.cascades", "6", "URP has up to 4 cascades"},
    {"light.cascades", "7", "URP has up to 4 cascades"},
    {"light.cascades", "8", "URP has up to 4 cascades"},
};

double urp_radius(const EngineValues& values) {
    return kUrpRadii[std::size_t(engine_value(urp_profile(), values, "softShadowQuality"))];
}

double hidden_urp(const EngineProfile&, const EngineValues&, const MapFacts& facts) {
    return raster_equivalent(kUrpHiddenSlope, 1, facts);
}

BiasNumbers read_urp(const EngineProfile& profile, const EngineValues& values, const MapFacts&) {
    BiasNumbers out;
    const double radius = urp_radius(values);
    out.constant_texels = engine_value(profile, values, "shadowDepthBias") * radius;
    out.normal_texels = engine_value(profile, values, "shadowNormalBias") * radius;
    out.normal_by = OffsetBy::OneMinusCosine;
    out.raster_slope = kUrpHiddenSlope;
    out.raster_units = 1;
    return out;
}

/// Returns the part of the normal offset that counts by the engine's own rule, in texels. Another one becomes a depth
/// bias: the engine's offset hardly acts at small angles.
double own_normal_texels(const BiasNumbers& bias) {
    return bias.settings_by == OffsetBy::OneMinusCosine ? bias.settings_normal_texels : 0;
}

/// Writes the engine's normal offset. @param own_texels part of the offset by the engine's own rule
void put_normal(const BiasNumbers& bias, double own_texels, double radius, const MapFacts& facts, EngineOutput& to) {
    const bool converted = own_texels == 0 && bias.normal_texels != 0;
    const double literal = own_texels != 0 ? own_texels : quotient(bias.normal_texels, 1 - cos_angle(facts));
    to.put("shadowNormalBias", own_texels / radius, converted ? Exactness::EqualAtAngle : Exactness::Exact,
           own_texels * offset_equivalent(OffsetBy::OneMinusCosine, facts.angle_deg), literal / radius,
           converted ? "in shadowDepthBias" : "");
}

void write_urp(const BiasNumbers& bias, const EngineValues& values, const MapFacts& facts, EngineOutput& to) {
    const double radius = urp_radius(values), own = own_normal_texels(bias);
    const double own_equivalent = own * offset_equivalent(OffsetBy::OneMinusCosine, facts.angle_deg);
    const double left =
        std::max(0.0, bias.total_texels(facts) - own_equivalent - hidden_urp(urp_profile(), values, facts));
    // Settings as the profile draws them hold the hidden offset, and the constant stands beside it.
    const bool is_drawn =
        bias.raster_slope == kUrpHiddenSlope && bias.raster_units == 1 && (bias.normal_texels == 0 || own != 0);
    to.put("shadowDepthBias", left / radius, is_drawn ? bias.constant : Exactness::EqualAtAngle, left,
           bias.constant_texels / radius,
           is_drawn ? bias.constant_note : "what the hidden polygon offset leaves to give");
    put_normal(bias, own, radius, facts, to);
}

BiasNumbers read_urp_slope(const EngineProfile& profile, const EngineValues& values, const MapFacts&) {
    BiasNumbers out;
    const double radius = urp_radius(values);
    out.raster_slope = kUrpSlope * engine_value(profile, values, "shadowDepthBias") * radius;
    out.normal_texels = engine_value(profile, values, "shadowNormalBias") * radius;
    out.normal_by = OffsetBy::OneMinusCosine;
    return out;
}

void write_urp_slope(const BiasNumbers& bias, const EngineValues& values, const MapFacts& facts, EngineOutput& to) {
    const double own = own_normal_texels(bias);
    const double wanted = bias.total_texels(facts) - own * offset_equivalent(OffsetBy::OneMinusCosine, facts.angle_deg);
    to.put_slope("shadowDepthBias", kUrpSlope * urp_radius(values), wanted, bias);
    put_normal(bias, own, urp_radius(values), facts, to);
}

}  // namespace

const EngineProfile& urp_profile() {
    static const EngineProfile row{.name = "urp",
                                   .title = "Unity URP, legacy depth bias",
                                   .version = "Unity 2022.2 to 6, Depth bias mode Legacy",
                                   .parameters = kUrpParameters,
                                   .forced = kUrpForced,
                                   .lacking = kUrpLacking,
                                   .bias_rows = kConstantAndNormal,
                                   .normal_by = OffsetBy::OneMinusCosine,
                                   .cascades_share_map = true,
                                   .hidden_texels = hidden_urp,
                                   .read_bias = read_urp,
                                   .write_bias = write_urp};
    return row;
}

const EngineProfile& urp_slope_profile() {
    static const EngineProfile row{.name = "urp-slope",
                                   .title = "Unity URP, slope-scale depth bias",
                                   .version = "Unity 6, Depth bias mode Slope-Scale",
                                   .unverified = "the version of the package that brings this mode",
                                   .parameters = kUrpSlopeParameters,
                                   .lacking = kUrpLacking,
                                   .bias_rows = kRasterAndNormal,
                                   .normal_by = OffsetBy::OneMinusCosine,
                                   .cascades_share_map = true,
                                   .read_bias = read_urp_slope,
                                   .write_bias = write_urp_slope};
    return row;
}

}  // namespace si
