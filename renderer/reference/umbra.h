// Pixels in full shadow together with everything that a shadow kernel reads around them: light there is a leak.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/reference/reference_task.h"

namespace si {

/// Finds the pixels in the umbra: the pixel and the surface around it, out to the kernel's reach, lie in full shadow.
/// Light at these pixels is a leak. The reference must be 0 at the pixel, and at 8 points around it on the plane of its
/// surface: the corners and side centres of a square that extends `reach_texels` to each side along the axes of the
/// light's map. The coarser of two blended maps counts. Traces rays for the points, and caches results in
/// TracedReference::umbra.
/// @param light the light of the frame; without map views only the pixel itself is tested
/// @param size texels of the light's maps
/// @param reach_texels distance that the kernel reads from its centre
/// @param pixels indices into the reference
/// @returns one number per element of `pixels`: 1 in the umbra, else 0
/// @throws Cancelled
std::vector<std::uint8_t> umbra_of(const TracedReference& traced, const FittedLight& light, MapSize size,
                                   double reach_texels, std::span<const std::size_t> pixels, const Workers& workers);

/// Returns true when a receiver, and 8 points around it on its surface, are dark for a light without size. The points
/// are those of umbra_of().
/// @param query the light and its casters; its options are ignored
/// @param size texels of the light's maps
/// @param reach_texels distance of the points from the receiver
bool in_umbra(const ReferenceScene& scene, const Receiver& receiver, const ReferenceQuery& query,
              const FittedLight& light, MapSize size, double reach_texels);

}  // namespace si
