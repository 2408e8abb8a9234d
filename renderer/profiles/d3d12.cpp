// Profile of Direct3D 12.
#include "renderer/profiles/api_bias.h"

namespace si {
namespace {

constexpr std::string_view kD3d12Source = "learn.microsoft.com: Depth Bias";

constexpr EngineParameter kD3d12Parameters[] = {
    {.key = "SlopeScaledDepthBias",
     .unit = "x depth slope",
     .standard = 0,
     .min = -100,
     .max = 100,
     .meaning = "Offset by the slope of the triangle while the map is drawn. Negative under reversed depth.",
     .source = kD3d12Source,
     .setting = "bias.raster_slope",
     .is_bias = true},
    {.key = "DepthBias",
     .unit = "depth steps",
     .standard = 0,
     .min = -1e7,
     .max = 1e7,
     .meaning = "Offset by steps of the depth format while the map is drawn. Negative under reversed depth.",
     .source = kD3d12Source,
     .setting = "bias.raster_units",
     .is_bias = true},
    {.key = "DepthBiasClamp",
     .unit = "depth",
     .standard = 0,
     .min = -1,
     .max = 1,
     .meaning = "Largest offset; 0 is no limit. Negative under reversed depth.",
     .source = kD3d12Source,
     .setting = "bias.raster_clamp",
     .is_bias = true},
    {.key = "shader.depthBias",
     .unit = "normalised depth",
     .standard = 0,
     .min = 0,
     .max = 1,
     .meaning = "Number of your own shader: subtracted from the receiver's depth, added under reversed depth.",
     .source = kD3d12Source,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "shader.normalOffset",
     .unit = "m",
     .standard = 0,
     .min = 0,
     .max = 1e3,
     .meaning = "Number of your own shader: shift of the look-up along the geometric normal.",
     .source = kD3d12Source,
     .setting = "bias.normal",
     .is_bias = true},
};

constexpr ApiNames kD3d12Names{"SlopeScaledDepthBias", "DepthBias", "DepthBiasClamp", true};

BiasNumbers read_d3d12(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    return read_api_bias(kD3d12Names, profile, values, facts);
}

void write_d3d12(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    write_api_bias(kD3d12Names, bias, facts, to);
}

}  // namespace

const EngineProfile& d3d12_profile() {
    static const EngineProfile row{.name = "d3d12",
                                   .title = "Direct3D 12",
                                   .version = "11 and 12",
                                   .unverified = "the size of a unit for float formats",
                                   .parameters = kD3d12Parameters,
                                   .read_bias = read_d3d12,
                                   .write_bias = write_d3d12};
    return row;
}

}  // namespace si
