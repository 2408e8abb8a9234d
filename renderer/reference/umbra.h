// Pixels in full shadow together with everything that a shadow kernel reads around them: light there is a leak.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/reference/reference_task.h"

namespace si {

/// Finds the pixels of a traced reference that lie in the umbra at a kernel's reach: R = 0 at the pixel, and at 8
/// points around it on the plane of its surface. The points lie at the corners and side centres of a square of
/// `reach_texels` to either side, along the axes of the light's map; in a blend of two maps those of the coarser one.
/// Rays decide, as in the reference. Pixels that were traced before come from TracedReference::umbra.
/// @param light the light of the frame; without views only the pixel itself is tested
/// @param resolution texels a side of its maps
/// @param pixels indices into the reference
/// @returns one number per element of `pixels`: 1 in the umbra, else 0 @throws Cancelled
std::vector<std::uint8_t> umbra_of(const TracedReference& traced, const FittedLight& light, MapSize size,
                                   double reach_texels, std::span<const std::size_t> pixels, const Workers& workers);

/// Returns true when a receiver and the 8 points around it at `reach_texels` are dark for a light without size. The
/// definition is that of umbra_of(). @param query the light and its casters; its options are ignored
bool in_umbra(const ReferenceScene& scene, const Receiver& receiver, const ReferenceQuery& query,
              const FittedLight& light, MapSize size, double reach_texels);

}  // namespace si
