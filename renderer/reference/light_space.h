// Where true shadow edges are in the light's own picture, to tell errors of sampling from errors of bias.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
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

/// What is known of the true edge nearest to a pixel's footprint. One lies within x texels if `texels` <= x; none does if
/// else `searched` >= x; else it is unknown.
struct EdgeFact {
    float texels;    ///< to the nearest; infinite: none within `searched`
    float searched;  ///< texels; 0: not looked for
};
using EdgeImage = std::vector<EdgeFact>;
inline constexpr EdgeFact kUnknownEdge{std::numeric_limits<float>::infinity(), 0};

/// Of what the rays through a light's texels depend on beside the scene.
std::uint64_t texel_rays_key(const FittedLight& light, int map_resolution);

/// Finds what edge_distances() tells, and remembers the surfaces met along the light's rays: asked again with another bias,
/// kernel or camera, it traces only what is new.
class EdgeFinder {
public:
    /// `scene` must outlive it.
    EdgeFinder(const TruthScene& scene, const FittedLight& light, int map_resolution);
    ~EdgeFinder();
    /// Looks within `reach_texels` + 1 around each footprint asked for, unless `facts` say so far already.
    /// @param facts one per pixel @throws Cancelled
    void find(const Receivers& receivers, const Truth& truth, double reach_texels, std::span<const Footprint> footprints,
              EdgeImage& facts, const Workers& workers);
    std::uint64_t rays() const;  ///< traced so far

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace si
