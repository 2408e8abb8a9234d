// Repeats the shadow test of one pixel on the CPU, in double precision, from the stored depths of the map.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/inspect/probe.h"

namespace si {

/// Record of one texel fetch of the shadow kernel at one pixel, read back from the GPU. A texel that the kernel fetches
/// twice has two records.
struct RecordedTap {
    glm::ivec2 texel{0};  ///< x to the right, y up, before map.wrap
    double stored = 0;    ///< depth in the map, 0..1
    double weight = 0;    ///< share of the kernel's result
};

/// Surface point, visibility and fetched texels that the GPU recorded at one pixel for one light. test_light_at_pixel()
/// explains the pixel from them.
struct TestedPixel {
    int light = 0;  ///< index of the light in the settings light.*
    SurfacePoint point;
    bool receives = true;           ///< the surface receives shadows (object.PATH.receive)
    double visibility = 1;          ///< drawn visibility, 0 in shadow to 1 lit
    std::vector<RecordedTap> taps;  ///< texels that the kernel fetched
    KernelFacts kernel;
};

/// Repeats the GPU's shadow test of one pixel and one light on the CPU, to explain the pixel. Returns map coordinates,
/// bias terms, every tap of the kernel and a verdict in words.
/// @param pixel what the GPU recorded at the pixel
/// @param settings sanitised and within the driver's limits
/// @param size texels of the map
/// @param map stored depths of the light's view that the point falls into, top row first; empty: the light has no map
/// @param driver measured properties of the driver's rasteriser
Probe::PerLight test_light_at_pixel(const TestedPixel& pixel, const FittedLight& light, const Settings& settings,
                                    MapSize size, const FloatImage& map, const RasterTraits& driver);

}  // namespace si
