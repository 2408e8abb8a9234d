// Profile of Unreal 5, cascaded shadow maps.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kUnrealSource =
    "Epic's API pages; formula by third parties that cite ShadowRendering.cpp (UpdateShaderDepthBias)";

constexpr EngineParameter kUnrealParameters[] = {
    {.key = "ShadowBias",
     .standard = 0.5,
     .min = 0,
     .max = 100,
     .meaning = "Factor of the depth bias while the map is drawn. The slider ends at 1.",
     .source = kUnrealSource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "ShadowSlopeBias",
     .standard = 0.5,
     .min = 0,
     .max = 100,
     .meaning = "Factor of the part that grows with the slope of the vertex normal, up to 45 degrees.",
     .source = kUnrealSource,
     .setting = "bias.raster_slope",
     .is_bias = true},
    {.key = "r.Shadow.CSMDepthBias",
     .standard = 10,
     .min = 0,
     .max = 1000,
     .meaning = "Scale of ShadowBias; 20 in old versions 4.x.",
     .source = kUnrealSource},
    {.key = "r.Shadow.CSMSlopeScaleDepthBias",
     .standard = 3,
     .min = 0,
     .max = 1000,
     .meaning = "Scale of ShadowSlopeBias.",
     .source = kUnrealSource},
    {.key = "r.Shadow.ShadowMaxSlopeScaleDepthBias",
     .standard = 1,
     .min = 0,
     .max = 1000,
     .meaning = "Largest slope that counts.",
     .source = kUnrealSource},
    {.key = "r.Shadow.Virtual.NormalBias",
     .standard = 0.5,
     .min = 0,
     .max = 1000,
     .meaning = "Virtual shadow maps: shift of the look-up along the normal, by the distance to the camera. It has no "
                "part in cascaded maps.",
     .source = kUnrealSource,
     .is_bias = true},
    {.key = "r.Shadow.MaxCSMResolution",
     .unit = "texels",
     .standard = 2048,
     .min = 16,
     .max = 16384,
     .meaning = "Texels across the map of a cascade.",
     .source = kUnrealSource,
     .setting = "map.resolution",
     .scale = 1},
    {.key = "LightSourceAngle",
     .unit = "degrees",
     .standard = 0.5357,
     .min = 0,
     .max = 90,
     .meaning = "Angular diameter of the light.",
     .source = kUnrealSource,
     .setting = "light.size",
     .scale = 0.5},
    {.key = "DynamicShadowCascades",
     .standard = 3,
     .min = 1,
     .max = 8,
     .meaning = "Number of cascades.",
     .source = "from memory",
     .setting = "light.cascades",
     .scale = 1},
};

constexpr std::string_view kUnrealRows[] = {"constant", "raster"};

constexpr LackingSetting kUnrealLacking[] = {
    {"bias.normal", "", "cascaded maps of Unreal have no normal offset; it is in ShadowBias"},
    {"bias.slope", "", "the slope is in ShadowSlopeBias"},
    {"light.split", "manual", "cascades are split by an exponent"},
};

/// Numbers behind the formula: texels per ShadowBias, and slope part per texel of it at the reference angle.
struct UnrealScale {
    double per_bias, slope, largest_slope;
};

UnrealScale unreal_scale(const EngineValues& values) {
    const EngineProfile& profile = unreal_profile();
    return {engine_value(profile, values, "r.Shadow.CSMDepthBias") / 2,
            engine_value(profile, values, "r.Shadow.CSMSlopeScaleDepthBias") *
                engine_value(profile, values, "ShadowSlopeBias"),
            engine_value(profile, values, "r.Shadow.ShadowMaxSlopeScaleDepthBias")};
}

BiasNumbers read_unreal(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    const UnrealScale scale = unreal_scale(values);
    out.constant_texels = engine_value(profile, values, "ShadowBias") * scale.per_bias;
    out.raster_slope = out.constant_texels * scale.slope;
    // The largest slope that counts is a largest offset.
    out.raster_clamp = out.raster_slope * scale.largest_slope * facts.texel_m() / facts.depth_m;
    return out;
}

void write_unreal(const BiasNumbers& bias, const EngineValues& given, const MapFacts& facts, EngineOutput& to) {
    EngineValues values = given;
    values.try_emplace("ShadowSlopeBias", 0);
    const UnrealScale scale = unreal_scale(values);
    const double with_slope = 1 + scale.slope * std::min(tan_angle(facts), scale.largest_slope);
    const double wanted = bias.total_texels(facts);
    const bool is_exact = scale.slope == 0 && bias.normal_texels == 0 && bias.raster_texels(facts) == 0;
    to.put("ShadowBias", quotient(wanted, scale.per_bias * with_slope),
           is_exact ? bias.constant : Exactness::EqualAtAngle, wanted, quotient(bias.constant_texels, scale.per_bias),
           bias.constant_note);
    to.put("ShadowSlopeBias", values["ShadowSlopeBias"], Exactness::Exact, 0, 0);
    constexpr double kThousand = 1000;
    const double across_m = facts.view_m * std::tan(facts.view_fov_deg * std::numbers::pi / 360);
    const double at_distance = kThousand * bias.normal_texels * facts.texel_m() / across_m;
    to.put("r.Shadow.Virtual.NormalBias", at_distance, Exactness::EqualAtAngle, 0, at_distance,
           "not verified: for virtual shadow maps, at one distance from the camera");
}

}  // namespace

const EngineProfile& unreal_profile() {
    static const EngineProfile row{
        .name = "unreal",
        .title = "Unreal 5, cascaded shadow maps",
        .version = "5",
        .unverified = "all of it: Epic's source is not public, and the formulas are those of third parties",
        .parameters = kUnrealParameters,
        .lacking = kUnrealLacking,
        .bias_rows = kUnrealRows,
        .read_bias = read_unreal,
        .write_bias = write_unreal};
    return row;
}

}  // namespace si
