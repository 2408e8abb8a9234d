// Euclidean distance transform.
#pragma once

#include <cstdint>
#include <vector>

namespace si {

/// Computes for each pixel of an image the Euclidean distance in pixels to the nearest set pixel; infinite when no
/// pixel is set. Exact and linear in the number of pixels: Felzenszwalb and Huttenlocher, Distance Transforms of
/// Sampled Functions, Theory of Computing 8, 2012.
/// @param set width x height flags; other than 0: the pixel is set
std::vector<float> distance_to(const std::vector<std::uint8_t>& set, int width, int height);

}  // namespace si
