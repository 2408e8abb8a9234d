// Profile of OGRE 1.12.
#include "renderer/profiles/bias_numbers.h"

namespace si {
namespace {

constexpr std::string_view kOgreSource = "from memory of the manual: depth_bias of a pass";

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
    to.put("depth_bias.constant", negated(units), Exactness::EqualAtAngle, units / units_per_texel,
           negated(bias.raster_units), "not verified");
    to.put("depth_bias.slope", negated(bias.raster_slope), Exactness::Exact, bias.raster_slope * tan_angle(facts),
           negated(bias.raster_slope), "not verified");
    to.miss("bias.raster_clamp", bias.raster_clamp, "OGRE has no clamp of the polygon offset");
}

}  // namespace

const EngineProfile& ogre_profile() {
    static const EngineProfile row{
        .name = "ogre",
        .title = "OGRE 1.12",
        .version = "1.12",
        .unverified = "all of it: names and signs are from memory of the manual. A normal offset is one of your shader",
        .parameters = kOgreParameters,
        .bias_rows = kOgreRows,
        .read_bias = read_ogre,
        .write_bias = write_ogre};
    return row;
}

}  // namespace si
