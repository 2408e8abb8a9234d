// Euclidean distances to the nearest set pixel of an image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace si {

/// Computes for each pixel of an image the Euclidean distance in pixels to the nearest set pixel; infinite when no
/// pixel is set. Exact and linear in the number of pixels: Felzenszwalb and Huttenlocher, Distance Transforms of
/// Sampled Functions, Theory of Computing 8, 2012.
/// @param set width x height flags; other than 0: the pixel is set
std::vector<float> distance_to(const std::vector<std::uint8_t>& set, int width, int height);

/// Finds distances to the nearest set pixel of an image for single pixels. Takes less time than distance_to() where
/// few are asked for, most of them near set pixels: a look-up costs as many steps as the distance has pixels.
class NearestSetPixel {
public:
    /// Prepares an image for look-ups. @param set width x height flags; other than 0: the pixel is set
    NearestSetPixel(const std::vector<std::uint8_t>& set, int width, int height);
    /// Returns the value of distance_to() at one pixel. @param pixel index into the image's flags
    float distance(std::size_t pixel) const;

private:
    int width_;
    std::vector<int> in_column_;  ///< distance to the nearest set pixel of the same column
};

}  // namespace si
