// Profile of WebGPU.
#include "renderer/profiles/api_bias.h"

namespace si {
namespace {

constexpr ApiNames kWebgpuNames{.factor = "depthBiasSlopeScale",
                                .units = "depthBias",
                                .clamp = "depthBiasClamp",
                                .source = "gpuweb/gpuweb spec/index.bs",
                                .whole_units = true};

}  // namespace

const EngineProfile& webgpu_profile() {
    static const EngineProfile row = api_profile<kWebgpuNames>(
        {.name = "webgpu", .title = "WebGPU", .version = "gpuweb/gpuweb da251f90", .unverified = ""});
    return row;
}

}  // namespace si
