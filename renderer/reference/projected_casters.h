// Casters between one surface point and a light with a size, projected onto the light. Internal to this folder.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/reference/caster_tree.h"
#include "renderer/reference/reference_rays.h"
#include "renderer/reference/sample_places.h"
#include "renderer/reference/seen_light.h"

namespace si {

/// Triangles of casters between one surface point and a light with a size, projected onto the light. They tell which
/// sample points of the light the surface point sees, as shadow rays do. Few triangles are faster to project than many
/// rays are to trace. Schwarz and Stamminger, Bitmask Soft Shadows, Eurographics 2007, use projected occluders too.
class ProjectedCasters {
public:
    /// Projects the casters of a surface point. Returns false if rays have to decide, since a caster reaches into the
    /// light, or since more triangles meet the light than are faster to project. The list is then empty.
    /// @param casters triangles that CasterTree::collect() found in `shaft`
    /// @param origin start of the surface point's shadow rays, which lies in the shaft
    /// @param culls face culling by object, as HitRules::culls
    /// @param sun places of the light's sample points, which must outlive the next calls; null: the light is not
    /// directional
    bool project(const RayHierarchy& scene, const CasterTree& tree, const LightShaft& shaft,
                 const ShaftTriangles& casters, const glm::vec3& origin, const LightDisk& disk,
                 std::span<const ObjectTraits> culls, const SunPlaces* sun);
    /// Returns true if the casters certainly hide the whole light, or no part of it.
    bool hides_all_or_none() const { return hides_all_ || triangles_.empty(); }
    /// Returns true if one of the casters has an alpha test, which makes samples dear.
    bool has_masks() const { return masked_ > 0; }
    /// Finds the states of sample points of the light: lit or dark.
    /// @param samples sample points of the surface point that project() was given
    /// @param points numbers of the sample points
    /// @param seen receives their states
    void find_seen(const LightSamples& samples, std::span<const std::uint32_t> points, std::span<Seen> seen);

private:
    /// Triangle on the plane of a LightDisk. A place (x, y) is inside where no edge function x X + y Y + Z is negative.
    struct Triangle {
        glm::vec3 edges[3];               ///< (X, Y, Z), of unit length; each is opposite to a corner
        glm::vec3 weights{0};             ///< factors from edge functions to barycentric coordinates, up to their sum
        const AlphaMask* mask = nullptr;  ///< alpha test; null: solid
        std::uint32_t primitive = 0;      ///< triangle within the object
    };

    std::vector<Triangle> triangles_;
    bool hides_all_ = false;  ///< a solid triangle covers the whole light
    std::size_t masked_ = 0;  ///< triangles with an alpha test
    const SunPlaces* sun_ = nullptr;
    SamplePlaces places_;                ///< without `sun_`
    std::vector<std::int32_t> hidden_;   ///< by place: 1 if hidden, else 0
    std::vector<std::int32_t> inside_;   ///< by place: 1 inside the present triangle, else 0
    std::vector<std::int32_t> numbers_;  ///< working memory for numbers of casters or groups
    std::vector<Seen> table_;            ///< states of the first sample points

    /// Finds the states of the first 2^digits sample points, for the table.
    void fill_table(const LightSamples& samples, int digits);
    /// Finds the places that the triangles hide, and writes them to `hidden_`.
    void hide_places(const SamplePlaces& places);
};

}  // namespace si
