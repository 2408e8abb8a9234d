// Profile of Godot 4.
#include <algorithm>
#include <numbers>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kGodotSource = "godotengine/godot: light_storage.cpp, doc/classes/Light3D.xml";
/// Radii of the filter in texels, by soft_shadow_filter_quality.
constexpr double kGodotRadii[] = {1.0, 1.5, 2.0, 2.0, 3.0, 4.0};

constexpr EngineChoice kGodotQualities[] = {
    {"Hard", "filter.kernel=hw2x2|filter.kernel=hard"},
    {"SoftVeryLow", "filter.kernel=vogel filter.taps=1"},
    {"SoftLow", "filter.kernel=vogel filter.taps=4|filter.kernel=vogel filter.taps=5"},
    {"SoftMedium", "filter.kernel=vogel filter.taps=8|filter.kernel=pcf|filter.kernel=tent3|filter.kernel=tent"},
    {"SoftHigh", "filter.kernel=vogel filter.taps=16|filter.kernel=vogel|filter.kernel=poisson|filter.kernel=gauss"},
    {"SoftUltra", "filter.kernel=vogel filter.taps=32"},
};

constexpr EngineChoice kGodotReverse[] = {{"false", "caster.cull=back|caster.cull=none"},
                                          {"true", "caster.cull=front"}};
constexpr EngineChoice kGodotBits[] = {{"false", "map.format=d32f|map.format=d24"}, {"true", "map.format=d16"}};
constexpr EngineChoice kGodotModes[] = {{"Orthogonal", "light.cascades=1"},
                                        {"Parallel2Splits", "light.cascades=2"},
                                        {"Parallel4Splits", "light.cascades=4"}};

constexpr EngineParameter kGodotParameters[] = {
    {.key = "shadow_bias",
     .unit = "% of the depth range x softness",
     .standard = 0.1,
     .min = 0,
     .max = 10,
     .meaning = "Shift of the receiver towards the light. More filter quality or blur raises it.",
     .source = kGodotSource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "shadow_normal_bias",
     .unit = "texels",
     .standard = 2,
     .min = 0,
     .max = 10,
     .meaning = "Shift of the look-up along the normal, without its part along the light.",
     .source = kGodotSource,
     .setting = "bias.normal",
     .is_bias = true},
    {.key = "shadow_blur",
     .standard = 1,
     .min = 0.001,
     .max = 10,
     .meaning = "Factor of the filter's radius, and of the depth bias.",
     .source = kGodotSource,
     .setting = "filter.radius"},
    {.key = "soft_shadow_filter_quality",
     .standard = 2,
     .min = 0,
     .max = 5,
     .meaning = "Samples and radius of the filter (project setting).",
     .source = "godotengine/godot: renderer_scene_render_rd.cpp",
     .setting = "filter.kernel",
     .choices = kGodotQualities},
    {.key = "light_angular_distance",
     .unit = "degrees",
     .standard = 0,
     .min = 0,
     .max = 90,
     .meaning = "Above 0: soft shadows by the light's size; the depth bias then counts without the filter's radius.",
     .source = "godotengine/godot: doc/classes/Light3D.xml",
     .setting = "light.size",
     .scale = 0.5},
    {.key = "shadow_reverse_cull_face",
     .standard = 0,
     .min = 0,
     .max = 1,
     .meaning = "Back faces cast.",
     .source = kGodotSource,
     .setting = "caster.cull",
     .choices = kGodotReverse},
    {.key = "directional_shadow/size",
     .unit = "texels",
     .standard = 4096,
     .min = 256,
     .max = 16384,
     .meaning = "Texels across the atlas (project setting). 4 splits share it, with half the width each.",
     .source = kGodotSource,
     .setting = "map.resolution",
     .scale = 1},
    {.key = "directional_shadow/16_bits",
     .standard = 1,
     .min = 0,
     .max = 1,
     .meaning = "16-bit depth (project setting).",
     .source = "from memory",
     .setting = "map.format",
     .choices = kGodotBits},
    {.key = "directional_shadow_mode",
     .standard = 2,
     .min = 0,
     .max = 2,
     .meaning = "Number of cascades.",
     .source = kGodotSource,
     .setting = "light.cascades",
     .choices = kGodotModes},
    {.key = "directional_shadow_split_1",
     .standard = 0.1,
     .min = 0,
     .max = 1,
     .meaning = "Far end of the first cascade, as a share of the depth.",
     .source = kGodotSource,
     .setting = "light.split_1",
     .scale = 1},
    {.key = "directional_shadow_split_2",
     .standard = 0.2,
     .min = 0,
     .max = 1,
     .meaning = "Far end of the second cascade.",
     .source = kGodotSource,
     .setting = "light.split_2",
     .scale = 1},
    {.key = "directional_shadow_split_3",
     .standard = 0.5,
     .min = 0,
     .max = 1,
     .meaning = "Far end of the third cascade.",
     .source = kGodotSource,
     .setting = "light.split_3",
     .scale = 1},
};

constexpr ForcedSetting kGodotForced[] = {
    {"light.near_far", "pancaking", "casters before the map are clamped to its near plane"},
};

constexpr LackingSetting kGodotLacking[] = {
    {"bias.slope", "", "Godot has no slope bias"},
    {"bias.raster_slope", "", "Godot draws its maps without polygon offset"},
    {"bias.raster_units", "", "Godot draws its maps without polygon offset"},
    {"filter.kernel", "vsm", "Godot has no moments"},
    {"filter.kernel", "esm", "Godot has no moments"},
    {"light.cascades", "3", "Godot has 1, 2 or 4 splits"},
    {"light.cascades", "5", "Godot has 1, 2 or 4 splits"},
    {"light.cascades", "6", "Godot has 1, 2 or 4 splits"},
    {"light.cascades", "7", "Godot has 1, 2 or 4 splits"},
    {"light.cascades", "8", "Godot has 1, 2 or 4 splits"},
};

/// Returns the factor of the depth bias by softness.
double godot_softness(const EngineValues& values) {
    const EngineProfile& profile = godot_profile();
    const double blur = engine_value(profile, values, "shadow_blur");
    if (engine_value(profile, values, "light_angular_distance") > 0) return blur;
    return blur * kGodotRadii[std::size_t(engine_value(profile, values, "soft_shadow_filter_quality"))];
}

constexpr double kPercent = 100;

BiasNumbers read_godot(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    const double normal = engine_value(profile, values, "shadow_normal_bias");
    const double depth = engine_value(profile, values, "shadow_bias") / kPercent * godot_softness(values);
    const double texels = depth * facts.depth_m / facts.texel_m();
    const double axial = normal * cos_angle(facts);
    out.constant_unit = BiasUnit::Depth;
    out.normal_texels = normal;
    if (normal > 0 && axial <= texels) {
        // A full offset whose part along the light is taken from the constant.
        out.constant_texels = texels - axial;
        out.constant = Exactness::EqualAtAngle;
        out.constant_note = "less the part of bias.normal along the light, which shadow_normal_bias leaves out";
    } else {
        out.constant_texels = texels;
        out.normal_by = OffsetBy::Sideways;
    }
    return out;
}

void write_godot(const BiasNumbers& bias, const EngineValues& values, const MapFacts& facts, EngineOutput& to) {
    const double raster = bias.raster_texels(facts);
    const double axial = bias.normal_texels * cos_angle(facts);
    const double constant = bias.constant_texels + raster + axial;
    const double to_number = kPercent * facts.texel_m() / (facts.depth_m * godot_softness(values));
    const bool is_exact = raster == 0 && axial == 0;
    to.put("shadow_bias", constant * to_number, is_exact ? bias.constant : Exactness::EqualAtAngle, constant,
           bias.constant_texels * to_number,
           axial > 0 ? "with the part of the normal offset along the light" : bias.constant_note);
    to.put("shadow_normal_bias", bias.normal_texels, Exactness::Exact,
           bias.normal_texels * offset_equivalent(OffsetBy::Sideways, facts.angle_deg), bias.normal_texels);
    to.note("Godot fits width and depth range of the map to the camera: W and D change with it");
}

}  // namespace

const EngineProfile& godot_profile() {
    static const EngineProfile row{
        .name = "godot",
        .title = "Godot 4",
        .version = "4.6, Forward+ and Mobile",
        .unverified =
            "the Compatibility renderer, the default of 16_bits, and light_angular_distance as radius or diameter",
        .parameters = kGodotParameters,
        .forced = kGodotForced,
        .lacking = kGodotLacking,
        .bias_rows = kConstantAndNormal,
        .cascades_share_map = true,
        .read_bias = read_godot,
        .write_bias = write_godot};
    return row;
}

}  // namespace si
