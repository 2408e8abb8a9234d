#include "renderer/profiles/api_bias.h"

#include <cmath>

namespace si {

BiasNumbers read_api_bias(const ApiNames& names, const EngineProfile& profile, const EngineValues& values,
                          const MapFacts& facts) {
    const double sign = facts.reversed_z ? -1 : 1;
    BiasNumbers out;
    out.raster_slope = sign * engine_value(profile, values, names.factor);
    out.raster_units = sign * engine_value(profile, values, names.units);
    out.raster_clamp = sign * engine_value(profile, values, names.clamp);
    out.constant_unit = BiasUnit::Depth;
    out.constant_texels = engine_value(profile, values, "shader.depthBias") * facts.depth_m / facts.texel_m();
    out.normal_texels = engine_value(profile, values, "shader.normalOffset") / facts.texel_m();
    out.format = facts.format;
    out.reversed_z = facts.reversed_z;
    return out;
}

void write_api_bias(const ApiNames& names, const BiasNumbers& bias, const MapFacts& facts, EngineOutput& to) {
    const double sign = bias.reversed_z ? -1 : 1;
    const double depth_per_texel = facts.texel_m() / facts.depth_m, step = raster_unit_depth(bias.format);
    const bool equal_steps = bias.format == MapFormat::D16 || bias.format == MapFormat::D24;
    const double constant_units = bias.constant_texels * depth_per_texel / step;
    double units = bias.raster_units + (equal_steps ? constant_units : 0);
    std::string note = equal_steps ? bias.constant_note : "a constant has no fixed number of units in float maps";
    if (names.whole_units && units != std::round(units)) {
        units = std::round(units);
        note = "rounded: the API takes integers";
    }
    const auto signed_number = [&](double value) { return value == 0 ? 0 : sign * value; };
    to.put(names.factor, signed_number(bias.raster_slope), Exactness::Exact, bias.raster_slope * tan_angle(facts),
           signed_number(bias.raster_slope + quotient(bias.constant_texels, tan_angle(facts))));
    to.put(names.units, signed_number(units), equal_steps ? bias.constant : Exactness::Exact,
           units * step / depth_per_texel, signed_number(bias.raster_units + constant_units), note);
    to.put(names.clamp, signed_number(bias.raster_clamp), Exactness::Exact, 0, signed_number(bias.raster_clamp));
    const double depth = bias.constant_texels * depth_per_texel;
    to.put("shader.depthBias", equal_steps ? 0 : depth, equal_steps ? Exactness::Exact : bias.constant,
           equal_steps ? 0 : bias.constant_texels, depth, equal_steps ? "in the units" : bias.constant_note);
    const double metres = bias.normal_texels * facts.texel_m();
    to.put("shader.normalOffset", metres, Exactness::Exact,
           bias.normal_texels * offset_equivalent(OffsetBy::Length, facts.angle_deg), metres);
}

}  // namespace si
