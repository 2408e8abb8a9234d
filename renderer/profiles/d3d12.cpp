// Profile of Direct3D 12.
#include "renderer/profiles/api_bias.h"

namespace si {
namespace {

constexpr ApiNames kD3d12Names{.factor = "SlopeScaledDepthBias",
                               .units = "DepthBias",
                               .clamp = "DepthBiasClamp",
                               .source = "learn.microsoft.com: Depth Bias",
                               .whole_units = true};

}  // namespace

const EngineProfile& d3d12_profile() {
    static const EngineProfile row = api_profile<kD3d12Names>({.name = "d3d12",
                                                               .title = "Direct3D 12",
                                                               .version = "11 and 12",
                                                               .unverified = "the size of a unit for float formats"});
    return row;
}

}  // namespace si
