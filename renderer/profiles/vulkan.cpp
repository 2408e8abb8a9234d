// Profile of Vulkan.
#include "renderer/profiles/api_bias.h"

namespace si {
namespace {

constexpr ApiNames kVulkanNames{.factor = "depthBiasSlopeFactor",
                                .units = "depthBiasConstantFactor",
                                .clamp = "depthBiasClamp",
                                .source = "docs.vulkan.org: vkCmdSetDepthBias"};

}  // namespace

const EngineProfile& vulkan_profile() {
    static const EngineProfile row =
        api_profile<kVulkanNames>({.name = "vulkan",
                                   .title = "Vulkan",
                                   .version = "1.3",
                                   .unverified = "the size of a unit and of the slope for float formats"});
    return row;
}

}  // namespace si
