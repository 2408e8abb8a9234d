// Profile of PlayCanvas.
#include <algorithm>
#include <numbers>

#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kPlaycanvasSource = "npm playcanvas@2.23.3: scene/light.js, lightFunctionShadow.js";
constexpr double kPlaycanvasSlope = 10;          ///< polygon offset factor and units per shadowBias
constexpr double kPlaycanvasHiddenDepth = 1e-4;  ///< at the look-up, share of the depth range

constexpr EngineChoice kPlaycanvasTypes[] = {
    {"SHADOW_PCF1_32F", "filter.kernel=hw2x2|filter.kernel=hard"},
    {"SHADOW_PCF3_32F",
     "filter.kernel=tent3 filter.bilinear=true|filter.kernel=tent "
     "filter.size=3|filter.kernel=tent3|filter.kernel=pcf|filter.kernel=vogel"},
    {"SHADOW_PCF5_32F",
     "filter.kernel=castano5|filter.kernel=tent filter.size=5|filter.kernel=tent|filter.kernel=gauss"},
    {"SHADOW_VSM_32F", "filter.kernel=evsm2|filter.kernel=vsm"},
    {"SHADOW_PCSS_32F", "filter.kernel=pcss"},
};

constexpr EngineChoice kPlaycanvasCulls[] = {{"CULLFACE_BACK", "caster.cull=back"},
                                             {"CULLFACE_NONE", "caster.cull=none"},
                                             {"CULLFACE_FRONT", "caster.cull=front"}};

constexpr EngineParameter kPlaycanvasParameters[] = {
    {.key = "shadowBias",
     .standard = 0.05,
     .min = 0,
     .max = 1,
     .meaning = "Polygon offset while the map is drawn: factor and units are ten times this number.",
     .source = kPlaycanvasSource,
     .setting = "bias.raster_slope",
     .is_bias = true},
    {.key = "normalOffsetBias",
     .unit = "m",
     .standard = 0,
     .min = 0,
     .max = 1,
     .meaning = "Shift of the look-up along the vertex normal.",
     .source = kPlaycanvasSource,
     .setting = "bias.normal",
     .is_bias = true},
    {.key = "shadowResolution",
     .unit = "texels",
     .standard = 1024,
     .min = 16,
     .max = 16384,
     .meaning = "Texels across the map. 2 to 4 cascades share it, with half the width each.",
     .source = kPlaycanvasSource,
     .setting = "map.resolution",
     .scale = 1},
    {.key = "shadowType",
     .standard = 1,
     .min = 0,
     .max = 4,
     .meaning = "Filter and format.",
     .source = kPlaycanvasSource,
     .setting = "filter.kernel",
     .choices = kPlaycanvasTypes},
    {.key = "numCascades",
     .standard = 1,
     .min = 1,
     .max = 4,
     .meaning = "Number of cascades.",
     .source = kPlaycanvasSource,
     .setting = "light.cascades",
     .scale = 1},
    {.key = "cascadeDistribution",
     .standard = 0.5,
     .min = 0,
     .max = 1,
     .meaning = "Splits of cascades: 0 even, 1 logarithmic.",
     .source = kPlaycanvasSource,
     .setting = "light.split_lambda",
     .scale = 1},
    {.key = "material.cull",
     .standard = 0,
     .min = 0,
     .max = 2,
     .meaning = "Faces of a material that are neither drawn nor cast.",
     .source = "npm playcanvas@2.23.3: scene/renderer/shadow-renderer.js",
     .setting = "caster.cull",
     .choices = kPlaycanvasCulls},
};

constexpr ForcedSetting kPlaycanvasForced[] = {
    {"map.format", "d32f", "the default maps are 32-bit floats"},
};

constexpr LackingSetting kPlaycanvasLacking[] = {
    {"bias.slope", "", "the slope is in shadowBias, as polygon offset"},
    {"light.split", "manual", "cascades are split by cascadeDistribution alone"},
};

double hidden_playcanvas(const EngineProfile&, const EngineValues&, const MapFacts& facts) {
    return kPlaycanvasHiddenDepth * facts.depth_m / facts.texel_m();
}

BiasNumbers read_playcanvas(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    out.constant_unit = BiasUnit::Depth;
    out.constant_texels = hidden_playcanvas(profile, values, facts);
    out.constant_note = "hidden: 0.0001 of the depth range at the look-up";
    out.raster_slope = kPlaycanvasSlope * engine_value(profile, values, "shadowBias");
    out.raster_units = out.raster_slope;
    out.normal_texels = engine_value(profile, values, "normalOffsetBias") / facts.texel_m();
    return out;
}

void write_playcanvas(const BiasNumbers& bias, const EngineValues& values, const MapFacts& facts, EngineOutput& to) {
    const double wanted = bias.constant_texels + bias.raster_texels(facts);
    const double left = std::max(0.0, wanted - hidden_playcanvas(playcanvas_profile(), values, facts));
    const double per_number = raster_equivalent(kPlaycanvasSlope, kPlaycanvasSlope, facts);
    to.put("shadowBias", quotient(left, per_number), Exactness::EqualAtAngle, left,
           quotient(bias.constant_texels, per_number), "a slope; " + std::string("a constant has no counterpart"));
    to.put_length_offset("normalOffsetBias", bias.normal_texels * facts.texel_m(), bias);
}

}  // namespace

const EngineProfile& playcanvas_profile() {
    static const EngineProfile row{.name = "playcanvas",
                                   .title = "PlayCanvas",
                                   .version = "2.23.3",
                                   .parameters = kPlaycanvasParameters,
                                   .forced = kPlaycanvasForced,
                                   .lacking = kPlaycanvasLacking,
                                   .bias_rows = kRasterAndNormal,
                                   .cascades_share_map = true,
                                   .hidden_depth = kPlaycanvasHiddenDepth,
                                   .hidden_texels = hidden_playcanvas,
                                   .read_bias = read_playcanvas,
                                   .write_bias = write_playcanvas};
    return row;
}

}  // namespace si
