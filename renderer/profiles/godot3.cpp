// Profile of Godot 3, whose GLES3 renderer shifts casters.
#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kGodot3Source =
    "godotengine/godot 3.2.3: gles3/shaders/scene.glsl (z_offset), rasterizer_scene_gles3.cpp (render_shadow); "
    "measured";
constexpr std::string_view kGodot3Nodes = "godotengine/godot 3.2.3: scene/3d/light.cpp";

constexpr EngineChoice kGodot3Filters[] = {
    {"Disabled", "filter.kernel=hw2x2|filter.kernel=hard"},
    {"PCF5", "filter.kernel=pcf filter.size=3|filter.kernel=tent3|filter.kernel=tent filter.size=3"},
    {"PCF13",
     "filter.kernel=pcf filter.size=5|filter.kernel=tent|filter.kernel=pcf|filter.kernel=gauss|filter.kernel=vogel|"
     "filter.kernel=poisson"},
};
constexpr EngineChoice kGodot3Reverse[] = {{"false", "caster.cull=back|caster.cull=none"},
                                           {"true", "caster.cull=front"}};
constexpr EngineChoice kGodot3Modes[] = {{"Orthogonal", "light.cascades=1"},
                                         {"Parallel2Splits", "light.cascades=2"},
                                         {"Parallel4Splits", "light.cascades=4"}};

constexpr EngineParameter kGodot3Parameters[] = {
    {.key = "shadow_bias",
     .unit = "m",
     .standard = 0.1,
     .min = -16,
     .max = 16,
     .meaning = "Shift of casters away from the light.",
     .source = kGodot3Source,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "directional_shadow_normal_bias",
     .unit = "m",
     .standard = 0.8,
     .min = 0,
     .max = 16,
     .meaning = "Shift of casters away from the light, times 1 - cosine of the angle. Not along the normal.",
     .source = kGodot3Source,
     .setting = "bias.slope",
     .is_bias = true},
    {.key = "directional_shadow_bias_split_scale",
     .standard = 0.25,
     .min = 0,
     .max = 1,
     .meaning = "Growth of both with the size of later cascades. The first counts as it is.",
     .source = kGodot3Source},
    {.key = "filter_mode",
     .standard = 1,
     .min = 0,
     .max = 2,
     .meaning = "Points of the filter, each a 2x2 comparison (project setting quality/shadows/filter_mode).",
     .source = "godotengine/godot 3.2.3: gles3/shaders/scene.glsl (sample_shadow)",
     .setting = "filter.kernel",
     .choices = kGodot3Filters},
    {.key = "shadow_reverse_cull_face",
     .standard = 0,
     .min = 0,
     .max = 1,
     .meaning = "Back faces cast.",
     .source = kGodot3Nodes,
     .setting = "caster.cull",
     .choices = kGodot3Reverse},
    {.key = "directional_shadow/size",
     .unit = "texels",
     .standard = 4096,
     .min = 256,
     .max = 16384,
     .meaning = "Texels across the atlas (project setting). 4 splits share it, with half the width each.",
     .source = "godotengine/godot 3.2.3: rasterizer_scene_gles3.cpp",
     .setting = "map.resolution",
     .scale = 1},
    {.key = "directional_shadow_mode",
     .standard = 2,
     .min = 0,
     .max = 2,
     .meaning = "Number of cascades.",
     .source = kGodot3Nodes,
     .setting = "light.cascades",
     .choices = kGodot3Modes},
};

constexpr ForcedSetting kGodot3Forced[] = {
    {"map.format", "d24", "the map of directional lights is 24-bit depth"},
};

constexpr std::string_view kGodot3Rows[] = {"constant"};

constexpr LackingSetting kGodot3Lacking[] = {
    {"bias.normal", "", "Godot 3 has no offset along the normal; its normal bias is a depth"},
    {"bias.raster_slope", "", "Godot 3 has no polygon offset"},
    {"bias.raster_units", "", "Godot 3 has no polygon offset"},
    {"filter.kernel", "pcss", "Godot 3 has no contact hardening"},
    {"filter.kernel", "vsm", "Godot 3 has no moments"},
    {"light.cascades", "3", "Godot 3 has 1, 2 or 4 cascades"},
    {"light.cascades", "5", "Godot 3 has 1, 2 or 4 cascades"},
    {"light.cascades", "6", "Godot 3 has 1, 2 or 4 cascades"},
    {"light.cascades", "7", "Godot 3 has 1, 2 or 4 cascades"},
    {"light.cascades", "8", "Godot 3 has 1, 2 or 4 cascades"},
};

BiasNumbers read_godot3(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    const double by_angle_m = engine_value(profile, values, "directional_shadow_normal_bias") * (1 - cos_angle(facts));
    out.constant_texels = (engine_value(profile, values, "shadow_bias") + by_angle_m) / facts.texel_m();
    out.constant_unit = BiasUnit::Metres;
    if (by_angle_m != 0) {
        out.constant = Exactness::EqualAtAngle;
        out.constant_note = "directional_shadow_normal_bias grows with the angle; the number is a constant";
    }
    return out;
}

void write_godot3(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    const double texels = bias.total_texels(facts);
    const bool is_constant = texels == bias.constant_texels;
    to.put("shadow_bias", texels * facts.texel_m(), is_constant ? bias.constant : Exactness::EqualAtAngle, texels,
           bias.constant_texels * facts.texel_m(),
           is_constant ? bias.constant_note : "with normal offset and polygon offset, which Godot 3 lacks");
    const double other_m = (texels - bias.constant_texels) * facts.texel_m();
    to.put("directional_shadow_normal_bias", 0, is_constant ? Exactness::Exact : Exactness::EqualAtAngle, 0,
           quotient(other_m, 1 - cos_angle(facts)), is_constant ? "" : "in shadow_bias");
    to.note("Godot 3 fits width and depth range of the map by itself: W and D change with the camera");
}

}  // namespace

const EngineProfile& godot3_profile() {
    static const EngineProfile row{.name = "godot3",
                                   .title = "Godot 3",
                                   .version = "3.2, GLES3",
                                   .unverified = "filters but Disabled, and cascades behind the first",
                                   .parameters = kGodot3Parameters,
                                   .forced = kGodot3Forced,
                                   .lacking = kGodot3Lacking,
                                   .bias_rows = kGodot3Rows,
                                   .cascades_share_map = true,
                                   .read_bias = read_godot3,
                                   .write_bias = write_godot3};
    return row;
}

}  // namespace si
