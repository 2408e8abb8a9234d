// Profile of three.js.
#include <algorithm>
#include <numbers>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kThreeSource = "npm three@0.187.0: LightShadow.js, shadowmap_pars_fragment.glsl.js";

constexpr EngineChoice kThreeTypes[] = {
    {"BasicShadowMap", "filter.kernel=hard"},
    {"PCFShadowMap",
     "filter.kernel=vogel filter.taps=5 filter.bilinear=true|filter.kernel=vogel "
     "filter.taps=5|filter.kernel=vogel|filter.kernel=hw2x2|filter.kernel=pcf|filter.kernel=poisson|"
     "filter.kernel=tent|filter.kernel=gauss"},
    {"VSMShadowMap",
     "filter.kernel=vsm filter.bleed=0.3 filter.min_variance=1e-7 filter.blur_shape=box "
     "filter.moment_format=16-bit|filter.kernel=vsm"},
};

constexpr EngineChoice kThreeSides[] = {
    {"FrontSide", "caster.cull=back"}, {"BackSide", "caster.cull=front"}, {"DoubleSide", "caster.cull=none"}};

constexpr EngineParameter kThreeParameters[] = {
    {.key = "bias",
     .unit = "normalised depth",
     .standard = 0,
     .min = -1,
     .max = 1,
     .meaning = "Added to the receiver's depth before the comparison. Negative removes acne.",
     .source = kThreeSource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "normalBias",
     .unit = "m",
     .standard = 0,
     .min = 0,
     .max = 1e3,
     .meaning = "Shift of the look-up along the vertex normal, in world units. Not scaled by texel or cascade.",
     .source = kThreeSource,
     .setting = "bias.normal",
     .is_bias = true},
    {.key = "mapSize",
     .unit = "texels",
     .standard = 512,
     .min = 1,
     .max = 16384,
     .meaning = "Texels across the map.",
     .source = kThreeSource,
     .setting = "map.resolution",
     .scale = 1},
    {.key = "shadowMap.type",
     .standard = 1,
     .min = 0,
     .max = 2,
     .meaning = "Filter. PCF takes 5 points of Vogel's spiral, each a comparison of 2x2 texels. PCFSoft no longer "
                "exists.",
     .source = "npm three@0.187.0: WebGLShadowMap.js",
     .setting = "filter.kernel",
     .choices = kThreeTypes},
    {.key = "radius",
     .unit = "texels",
     .standard = 1,
     .min = 0,
     .max = 100,
     .meaning = "Radius of the PCF disk; half width of the blur under VSM.",
     .source = kThreeSource,
     .setting = "filter.radius",
     .scale = 1},
    {.key = "shadowSide",
     .standard = 1,
     .min = 0,
     .max = 2,
     .meaning =
         "Faces that cast. Without it one-sided materials cast with their back faces, and double-sided ones with "
         "both.",
     .source = "npm three@0.187.0: WebGLShadowMap.js",
     .setting = "caster.cull",
     .choices = kThreeSides,
     .holds_for_double_sided = true},
    {.key = "shadow.camera.right",
     .unit = "m",
     .standard = 5,
     .min = 1e-6,
     .max = 1e6,
     .meaning = "Half of the width of the map. Set left, top and bottom to the same, and fit the light by hand.",
     .source = "npm three@0.187.0: DirectionalLightShadow.js",
     .setting = "light.extent",
     .scale = 1},
};

constexpr ForcedSetting kThreeForced[] = {
    {"map.format", "d24", "Basic and PCF maps are 24-bit depth"},
};

constexpr LackingSetting kThreeLacking[] = {
    {"bias.slope", "", "three.js has no slope bias; biasNode of WebGPU takes any formula"},
    {"bias.raster_slope", "", "polygon offset only by an own customDepthMaterial"},
    {"bias.raster_units", "", "polygon offset only by an own customDepthMaterial"},
    {"filter.kernel", "pcss", "three.js has no contact hardening"},
};

BiasNumbers read_three(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    out.constant_unit = BiasUnit::Depth;
    out.constant_texels = -engine_value(profile, values, "bias") * facts.depth_m / facts.texel_m();
    out.normal_texels = engine_value(profile, values, "normalBias") / facts.texel_m();
    return out;
}

void write_three(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    const double raster = bias.raster_texels(facts);
    const double constant = bias.constant_texels + raster;
    const double to_depth = -facts.texel_m() / facts.depth_m;
    to.put("bias", constant == 0 ? 0 : constant * to_depth, raster == 0 ? bias.constant : Exactness::EqualAtAngle,
           constant, bias.constant_texels * to_depth, bias.constant_note);
    to.put_length_offset("normalBias", bias.normal_texels * facts.texel_m(), bias);
}

}  // namespace

const EngineProfile& three_profile() {
    static const EngineProfile row{.name = "three",
                                   .title = "three.js",
                                   .version = "r187",
                                   .unverified = "normalBias under VSM and of BatchedMesh",
                                   .parameters = kThreeParameters,
                                   .forced = kThreeForced,
                                   .lacking = kThreeLacking,
                                   .bias_rows = kConstantAndNormal,
                                   .read_bias = read_three,
                                   .write_bias = write_three};
    return row;
}

}  // namespace si
