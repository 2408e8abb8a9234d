// Where true shadow edges are in the light's own picture, to tell errors of sampling from errors of bias.
#pragma once

#include <vector>

#include "renderer/light_fit.h"
#include "renderer/reference/truth.h"

namespace si {

/// What a kernel looks at for a pixel.
struct Footprint {
    glm::dvec2 centre{0};  ///< of the kernel, in texels from the map's corner (v up), normal offset included
    glm::dvec2 own{0};     ///< of the surface itself
    int view = -1;         ///< of the light's; below 0: not asked for
};

/// For each pixel asked for, the Chebyshev distance in texels from its footprint to the nearest texel centre at which the
/// truth is not the pixel's, infinite when there is none within `reach_texels` + 1: by one more than what the kernel
/// reads, so that an edge that crosses the footprint has centres on both sides.
///
/// The truth at a texel centre: along the light's ray through it, of all surfaces met the one nearest to the receiver's
/// plane stands for the receiver; it is lit when no other is met before it. So an edge counts though the camera does not
/// see it, and a bent or folded receiver, whose neighbouring facets rise above its plane, has no edge for that: what it
/// shadows is acne. The footprint is the square around the kernel's centre, stretched to the surface's own place, as a
/// normal offset moves edges.
///
/// Chosen over distances in the picture (which miss edges hidden from the camera and know no texels) and over rays all
/// over the footprint (25 to 150 for each pixel): texels are traced once, in tiles, and only where pixels ask.
/// @throws Cancelled
std::vector<float> edge_distances(const TruthScene& scene, const Receivers& receivers, const Truth& truth,
                                  const FittedLight& light, int map_resolution, double reach_texels,
                                  const std::vector<Footprint>& footprints, const Workers& workers);

}  // namespace si
