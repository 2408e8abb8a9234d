// Distances to the nearest of a set of pixels.
#pragma once

#include <cstdint>
#include <vector>

namespace si {

/// Euclidean distance, in pixels, from each pixel's centre to the nearest pixel that is set; infinite when none is.
/// Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions, Theory of Computing 8, 2012: exact, and
/// linear in the number of pixels.
std::vector<float> distance_to(const std::vector<std::uint8_t>& set, int width, int height);

}  // namespace si
