// Profile of OGRE 1.12.
#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kOgreSource =
    "OGRECave/ogre 1.12.10: OgreGL3PlusRenderSystem.cpp (_setDepthBias), OgreShadowRenderer.cpp; measured";

constexpr EngineChoice kOgreReceivers[] = {
    {"SGX_ShadowPCF4",
     "filter.kernel=pcf filter.size=2|filter.kernel=tent3|filter.kernel=hw2x2|filter.kernel=hard|filter.kernel=pcf|"
     "filter.kernel=tent|filter.kernel=gauss|filter.kernel=vogel|filter.kernel=poisson"}};
constexpr EngineChoice kOgreFaces[] = {{"false", "caster.cull=back"}, {"true", "caster.cull=front"}};
constexpr EngineChoice kOgreFormats[] = {{"PF_DEPTH16", "map.format=d16"},
                                         {"PF_DEPTH32F", "map.format=d32f|map.format=d24"}};

constexpr EngineParameter kOgreParameters[] = {
    {.key = "depth_bias.constant",
     .unit = "depth steps",
     .standard = 0,
     .min = -1e6,
     .max = 1e6,
     .meaning = "Offset of the caster material; positive is nearer, so that bias is negative.",
     .source = kOgreSource,
     .setting = "bias.raster_units",
     .is_bias = true},
    {.key = "depth_bias.slope",
     .unit = "x depth slope",
     .standard = 0,
     .min = -100,
     .max = 100,
     .meaning = "Offset by slope of the caster material; positive is nearer, so that bias is negative.",
     .source = kOgreSource,
     .setting = "bias.raster_slope",
     .is_bias = true},
    {.key = "receiver",
     .standard = 0,
     .min = 0,
     .max = 0,
     .meaning = "Filter of the RTShader system: 2x2 comparisons of 2x2 texels.",
     .source = "OGRECave/ogre 1.12.10: SGXLib_IntegratedPSSM.glsl",
     .setting = "filter.kernel",
     .choices = kOgreReceivers},
    {.key = "ShadowCasterRenderBackFaces",
     .standard = 1,
     .min = 0,
     .max = 1,
     .meaning = "Back faces of one-sided materials cast. By default they do.",
     .source = kOgreSource,
     .setting = "caster.cull",
     .choices = kOgreFaces},
    {.key = "ShadowTexturePixelFormat",
     .standard = 0,
     .min = 0,
     .max = 1,
     .meaning = "Depth format of the map. A depth step depends on it.",
     .source = "OGRECave/ogre 1.12.10: OgrePixelFormat.h",
     .setting = "map.format",
     .choices = kOgreFormats},
    {.key = "ShadowTextureSize",
     .unit = "texels",
     .standard = 512,
     .min = 1,
     .max = 16384,
     .meaning = "Texels across the map.",
     .source = "OGRECave/ogre 1.12.10: OgreSceneManager.h",
     .setting = "map.resolution",
     .scale = 1},
};

constexpr std::string_view kOgreRows[] = {"raster"};

BiasNumbers read_ogre(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    BiasNumbers out;
    out.raster_units = -engine_value(profile, values, "depth_bias.constant");
    out.raster_slope = -engine_value(profile, values, "depth_bias.slope");
    out.format = facts.format;
    return out;
}

void write_ogre(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    const double units_per_texel = facts.texel_m() / facts.depth_m / raster_unit_depth(bias.format);
    const double receiver = bias.receiver_texels(facts);
    const double units = bias.raster_units + receiver * units_per_texel;
    const auto negated = [](double value) { return value == 0 ? 0 : -value; };
    to.put("depth_bias.constant", negated(units), receiver == 0 ? Exactness::Exact : Exactness::EqualAtAngle,
           units / units_per_texel, negated(bias.raster_units),
           receiver == 0 ? "" : "a depth step is the driver's choice; Mesa's llvmpipe takes twice the usual one");
    to.put("depth_bias.slope", negated(bias.raster_slope), Exactness::Exact, bias.raster_slope * tan_angle(facts),
           negated(bias.raster_slope));
    to.miss("bias.raster_clamp", bias.raster_clamp, "OGRE has no clamp of the polygon offset");
}

}  // namespace

const EngineProfile& ogre_profile() {
    static const EngineProfile row{
        .name = "ogre",
        .title = "OGRE 1.12",
        .version = "1.12, GL3Plus and RTShader system",
        .unverified = "own shaders of receivers, and the fixed filters of other render systems",
        .parameters = kOgreParameters,
        .bias_rows = kOgreRows,
        .read_bias = read_ogre,
        .write_bias = write_ogre};
    return row;
}

}  // namespace si
