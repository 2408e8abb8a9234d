// Profile of WebGPU.
#include "renderer/profiles/api_bias.h"

namespace si {
namespace {

constexpr std::string_view kWebgpuSource = "gpuweb/gpuweb spec/index.bs";

constexpr EngineParameter kWebgpuParameters[] = {
    {.key = "depthBiasSlopeScale",
     .unit = "x depth slope",
     .standard = 0,
     .min = -100,
     .max = 100,
     .meaning = "Offset by the slope of the triangle while the map is drawn. Negative under reversed depth.",
     .source = kWebgpuSource,
     .setting = "bias.raster_slope",
     .is_bias = true},
    {.key = "depthBias",
     .unit = "depth steps",
     .standard = 0,
     .min = -1e7,
     .max = 1e7,
     .meaning = "Offset by steps of the depth format while the map is drawn. Negative under reversed depth.",
     .source = kWebgpuSource,
     .setting = "bias.raster_units",
     .is_bias = true},
    {.key = "depthBiasClamp",
     .unit = "depth",
     .standard = 0,
     .min = -1,
     .max = 1,
     .meaning = "Largest offset; 0 is no limit. Negative under reversed depth.",
     .source = kWebgpuSource,
     .setting = "bias.raster_clamp",
     .is_bias = true},
    {.key = "shader.depthBias",
     .unit = "normalised depth",
     .standard = 0,
     .min = 0,
     .max = 1,
     .meaning = "Number of your own shader: subtracted from the receiver's depth, added under reversed depth.",
     .source = kWebgpuSource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "shader.normalOffset",
     .unit = "m",
     .standard = 0,
     .min = 0,
     .max = 1e3,
     .meaning = "Number of your own shader: shift of the look-up along the geometric normal.",
     .source = kWebgpuSource,
     .setting = "bias.normal",
     .is_bias = true},
};

constexpr ApiNames kWebgpuNames{"depthBiasSlopeScale", "depthBias", "depthBiasClamp", true};

BiasNumbers read_webgpu(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    return read_api_bias(kWebgpuNames, profile, values, facts);
}

void write_webgpu(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    write_api_bias(kWebgpuNames, bias, facts, to);
}

}  // namespace

const EngineProfile& webgpu_profile() {
    static const EngineProfile row{.name = "webgpu",
                                   .title = "WebGPU",
                                   .version = "gpuweb/gpuweb da251f90",
                                   .unverified = "",
                                   .parameters = kWebgpuParameters,
                                   .read_bias = read_webgpu,
                                   .write_bias = write_webgpu};
    return row;
}

}  // namespace si
