// Profile of Vulkan.
#include "renderer/profiles/api_bias.h"

namespace si {
namespace {

constexpr std::string_view kVulkanSource = "docs.vulkan.org: vkCmdSetDepthBias";

constexpr EngineParameter kVulkanParameters[] = {
    {.key = "depthBiasSlopeFactor",
     .unit = "x depth slope",
     .standard = 0,
     .min = -100,
     .max = 100,
     .meaning = "Offset by the slope of the triangle while the map is drawn. Negative under reversed depth.",
     .source = kVulkanSource,
     .setting = "bias.raster_slope",
     .is_bias = true},
    {.key = "depthBiasConstantFactor",
     .unit = "depth steps",
     .standard = 0,
     .min = -1e7,
     .max = 1e7,
     .meaning = "Offset by steps of the depth format while the map is drawn. Negative under reversed depth.",
     .source = kVulkanSource,
     .setting = "bias.raster_units",
     .is_bias = true},
    {.key = "depthBiasClamp",
     .unit = "depth",
     .standard = 0,
     .min = -1,
     .max = 1,
     .meaning = "Largest offset; 0 is no limit. Negative under reversed depth.",
     .source = kVulkanSource,
     .setting = "bias.raster_clamp",
     .is_bias = true},
    {.key = "shader.depthBias",
     .unit = "normalised depth",
     .standard = 0,
     .min = 0,
     .max = 1,
     .meaning = "Number of your own shader: subtracted from the receiver's depth, added under reversed depth.",
     .source = kVulkanSource,
     .setting = "bias.constant",
     .is_bias = true},
    {.key = "shader.normalOffset",
     .unit = "m",
     .standard = 0,
     .min = 0,
     .max = 1e3,
     .meaning = "Number of your own shader: shift of the look-up along the geometric normal.",
     .source = kVulkanSource,
     .setting = "bias.normal",
     .is_bias = true},
};

constexpr ApiNames kVulkanNames{"depthBiasSlopeFactor", "depthBiasConstantFactor", "depthBiasClamp", false};

BiasNumbers read_vulkan(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts) {
    return read_api_bias(kVulkanNames, profile, values, facts);
}

void write_vulkan(const BiasNumbers& bias, const EngineValues&, const MapFacts& facts, EngineOutput& to) {
    write_api_bias(kVulkanNames, bias, facts, to);
}

}  // namespace

const EngineProfile& vulkan_profile() {
    static const EngineProfile row{.name = "vulkan",
                                   .title = "Vulkan",
                                   .version = "1.3",
                                   .unverified = "the size of a unit and of the slope for float formats",
                                   .parameters = kVulkanParameters,
                                   .read_bias = read_vulkan,
                                   .write_bias = write_vulkan};
    return row;
}

}  // namespace si
