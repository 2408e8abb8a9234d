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

/// Euclidean distances from single pixels of an image to the nearest set pixel. Faster than distance_to() for few
/// look-ups close to set pixels: the time of a look-up is proportional to the distance.
class NearestSetPixel {
public:
    /// Prepares an image for look-ups. @param set width x height flags; other than 0: the pixel is set
    NearestSetPixel(const std::vector<std::uint8_t>& set, int width, int height);
    /// Returns the distance in pixels from one pixel to the nearest set pixel; infinite when no pixel is set.
    /// @param pixel index into the image's flags
    float distance(std::size_t pixel) const;

private:
    int width_;
    std::vector<int> in_column_;  ///< distance to the nearest set pixel of the same column
};

}  // namespace si
