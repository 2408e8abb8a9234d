// The shadow test of one surface point again, in double and step by step, from the stored depths.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/inspect/probe.h"

namespace si {

/// A texel that the kernel read while it ran on the GPU; the same one may be read more than once.
struct RecordedTap {
    glm::ivec2 texel{0};  ///< x to the right, y up, before map.wrap
    double stored = 0, weight = 0;
};

/// What the GPU found at a pixel.
struct TestedPixel {
    int light = 0;
    SurfacePoint point;
    bool receives = true;
    double visibility = 1;          ///< by the renderer's filter
    std::vector<RecordedTap> taps;  ///< of its kernel
    KernelFacts kernel;
};

/// @param settings sanitised and within the driver's limits
/// @param map of the light's view that the point falls into, top row first; empty when it casts nothing
Probe::PerLight test_light_at_pixel(const TestedPixel& pixel, const FittedLight& light, const Settings& settings,
                                    int resolution, const FloatImage& map, const RasterTraits& driver);

}  // namespace si
