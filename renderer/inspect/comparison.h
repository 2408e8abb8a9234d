// The shadow test of one surface point again, in double and step by step, from the stored depths.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/inspect/probe.h"

namespace si {

/// What the GPU found at a pixel.
struct TestedPixel {
    int light = 0;
    SurfacePoint point;
    bool receives = true;
    double visibility = 1;  ///< by the renderer's filter
};

/// @param settings sanitised and within the driver's limits
/// @param map of the light's view that the point falls into, top row first; empty when it casts nothing
Probe::PerLight test_light(const TestedPixel& pixel, const FittedLight& light, const Settings& settings, int resolution,
                           const FloatImage& map, const RasterTraits& driver);

}  // namespace si
