// Places of a disk about a receiver, for kernels that sample a circle.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace si {

/// How many places the table of the Poisson disk has.
inline constexpr int kDiskTable = 64;

/// The first n places of a table in the unit disk, each the farthest from all before it of thousands thrown at random
/// (best candidates), so that the first few of them, too, lie well apart. Mitchell, Spectrally Optimal Sampling for
/// Distribution Ray Tracing, 1991. @param n at most kDiskTable
std::vector<glm::vec2> poisson_places(int n);

/// n places along a spiral over the unit disk, each a golden angle on: even whatever n is.
/// Vogel, A Better Way to Construct the Sunflower Head, Mathematical Biosciences 44, 1979.
std::vector<glm::vec2> spiral_places(int n);

}  // namespace si
