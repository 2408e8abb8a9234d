// Rounding errors of a picture's map look-ups in single precision, compared with double precision.
#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "renderer/frame/frame.h"

namespace si {

/// Shadow map look-ups that the GPU made for a picture's pixels, read back, top row first.
struct DrawnLookUps {
    SurfaceIds ids;
    FloatImage uvd;  ///< four channels: map coordinates, depth before bias, 1 + layer (0: no look-up)
};

/// Distribution of a rounding error over pixels: median, 99th percentile, largest. NaN without pixels.
struct PrecisionSpread {
    double median = std::numeric_limits<double>::quiet_NaN(), p99 = median, worst = median;
    glm::ivec2 worst_at{-1};  ///< pixel with the largest error, from the top left
};

/// Rounding errors of a picture's map look-ups in single precision: an image by pixel, and distributions over all
/// pixels.
struct Precision {
    FloatImage error;        ///< two channels: position error in texels, depth error in ULPs; NaN: no look-up
    std::size_t pixels = 0;  ///< number of pixels with a look-up
    /// Distance in the map from the look-up to the point where the pixel's ray meets its triangle, in texels. Includes
    /// the rasteriser's snapping of corners to parts of a pixel.
    PrecisionSpread texels;
    /// Distance of the depth from the triangle's plane at the look-up, in steps of a 32-bit float (ULP).
    PrecisionSpread ulps;
};

/// Measures the rounding errors of a picture's shadow map look-ups, which the GPU computes in single precision, by
/// comparing them with double precision.
/// @param camera,light camera and light of the frame that made the look-ups
/// @param size texels of the light's maps
Precision measure_precision(const Scene& scene, const Camera& camera, const FittedLight& light, MapSize size,
                            const DrawnLookUps& drawn);

}  // namespace si
