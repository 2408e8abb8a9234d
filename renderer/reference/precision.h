// What single precision does to a picture's look-ups: where each pixel's surface was looked up, against where it is by
// double precision.
#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "renderer/frame/frame.h"

namespace si {

/// What shaders computed of a picture's pixels, top row first.
struct DrawnLookUps {
    SurfaceIds ids;
    FloatImage uvd;  ///< four channels: map coordinates and depth before any bias, 1 + the layer among the light's
                     ///< views (0: no look-up)
};

/// Of one measure over all pixels that have it; NaN where there is none.
struct PrecisionSpread {
    double median = std::numeric_limits<double>::quiet_NaN(), p99 = median, worst = median;
    glm::ivec2 worst_at{-1};  ///< pixel from the top left
};

struct Precision {
    FloatImage error;        ///< two channels: texels, steps of a 32-bit depth; NaN where nothing is looked up
    std::size_t pixels = 0;  ///< that are looked up
    /// Distance in the map from where the pixel's ray meets its triangle. The rasteriser's own share, its snapping of
    /// corners to parts of a pixel, is within it.
    PrecisionSpread texels;
    /// How far the depth lies from the triangle's plane at the place that was looked up, in steps of a 32-bit float at
    /// that depth (ULP).
    PrecisionSpread ulps;
};

/// @param camera, light of the frame that drew them @param resolution of the map, texels a side
Precision measure_precision(const Scene& scene, const Camera& camera, const FittedLight& light, int resolution,
                            const DrawnLookUps& drawn);

}  // namespace si
