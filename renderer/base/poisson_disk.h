// Places of a disk about a receiver, for kernels that sample a circle.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace si {

/// Number of points in the table of the Poisson disk.
inline constexpr int kDiskTable = 64;

/// Returns the first `n` points of a table of sampling places in the unit disk (Poisson disk). Each point is the
/// farthest from all points before it among thousands of random candidates, so that any first `n` are well spread
/// (Mitchell, Spectrally Optimal Sampling for Distribution Ray Tracing, 1991).
/// @param n at most kDiskTable
std::vector<glm::vec2> poisson_places(int n);

/// Returns `n` evenly spread sampling places in the unit disk (Vogel disk). They lie on a spiral: each is turned by the
/// golden angle from the one before, which spreads them evenly for every `n`. Vogel, A Better Way to Construct the
/// Sunflower Head, Mathematical Biosciences 44, 1979.
std::vector<glm::vec2> spiral_places(int n);

}  // namespace si
