#include "renderer/profiles/api_bias.h"

#include <cmath>

namespace si {

std::array<EngineParameter, 5> api_parameters(const ApiNames& names) {
    return {{
        {.key = names.factor,
         .unit = "x depth slope",
         .standard = 0,
         .min = -100,
         .max = 100,
         .meaning = "Offset by the slope of the triangle while the map is drawn. Negative under reversed depth.",
         .source = names.source,
         .setting = "bias.raster_slope",
         .is_bias = true},
        {.key = names.units,
         .unit = "depth steps",
         .standard = 0,
         .min = -1e7,
         .max = 1e7,
         .meaning = "Offset by steps of the depth format while the map is drawn. Negative under reversed depth.",
         .source = names.source,
         .setting = "bias.raster_units",
         .is_bias = true},
        {.key = names.clamp,
         .unit = "depth",
         .standard = 0,
         .min = -1,
         .max = 1,
         .meaning = "Largest offset; 0 is no limit. Negative under reversed depth.",
         .source = names.source,
         .setting = "bias.raster_clamp",
         .is_bias = true},
        {.key = "shader.depthBias",
         .unit = "normalised depth",
         .standard = 0,
         .min = 0,
         .max = 1,
         .meaning = "Number of your own shader: subtracted from the receiver's depth, added under reversed depth.",
         .source = names.source,
         .setting = "bias.constant",
         .is_bias = true},
        {.key = "shader.normalOffset",
         .unit = "m",
         .standard = 0,
         .min = 0,
         .max = 1e3,
         .meaning = "Number of your own shader: shift of the look-up along the geometric normal.",
         .source = names.source,
         .setting = "bias.normal",
         .is_bias = true},
    }};
}

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
    to.put_length_offset("shader.normalOffset", bias.normal_texels * facts.texel_m(), bias);
}

}  // namespace si
