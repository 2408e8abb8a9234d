// Places of a disk about a receiver, for kernels that sample a circle.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace si {

/// Number of points in the table of the Poisson disk.
inline constexpr int kDiskTable = 64;

/// Returns the first n points of a Poisson disk table in the unit disk. Each point is the best of thousands of random
/// candidates, the one farthest from all points before it, so that any first n are well spread (Mitchell, Spectrally
/// Optimal Sampling for Distribution Ray Tracing, 1991). @param n at most kDiskTable
std::vector<glm::vec2> poisson_places(int n);

/// Returns `n` evenly spread points of the unit disk. They lie on a spiral, each turned by the golden angle from the
/// one before, which is even for every `n`. Vogel, A Better Way to Construct the Sunflower Head, Mathematical
/// Biosciences 44, 1979.
std::vector<glm::vec2> spiral_places(int n);

}  // namespace si
