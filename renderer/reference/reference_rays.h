// Rays through a ReferenceScene. Internal to this folder; others call trace_visibility() or first_caster_distances().
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <vector>

#include "renderer/reference/caster_tree.h"
#include "renderer/reference/embree.h"
#include "renderer/reference/receivers.h"

namespace si {

/// Object that casts shadows, in the ray-tracing hierarchy. The index in RayHierarchy::casters is the id of the
/// object's Embree geometry or instance.
struct Caster {
    std::uint32_t object = 0;
    bool mirrored = false;  ///< flattened with a mirroring transform: its winding is reversed
};

/// Ray-tracing hierarchy of a scene's casters in Embree. Coordinates are those of UnitFrame: moved to the scene's
/// centre and scaled to about unit size.
struct RayHierarchy : UnitFrame {
    TrackedMemory held{"hierarchies of rays", 0};  ///< bytes of Embree; declared before `device`, which updates it
    embree::Device device;
    std::vector<embree::Scene> meshes;  ///< one scene for each instanced mesh
    embree::Scene scene;
    std::vector<Caster> casters;
    const ReferenceGeometry* geometry = nullptr;
    double radius = 1;  ///< radius of the scene in these coordinates
    std::size_t triangles = 0, instances = 0;

    /// Returns the hierarchy that lists the casters between surface points and a light. Builds it at the first call.
    /// Returns null for a scene with instances. May be called on any thread. @throws Error, Cancelled
    const CasterTree* caster_tree(const std::stop_token& stop) const;

private:
    mutable std::mutex tree_lock_;
    mutable std::unique_ptr<const CasterTree> tree_;
};

/// Shadow ray at a grazing angle to its receiver, for which single precision is not enough. Its hits are tested again
/// in double precision, without the receiver's own triangle.
struct ExactRay {
    glm::dvec3 origin{0}, direction{0};  ///< in UnitFrame coordinates; direction of unit length
    double length = 0;
    std::uint32_t object = 0, primitive = 0;
};
/// Cosine between surface normal and ray below which a ray is traced as an ExactRay (hits tested in double precision).
inline constexpr double kGrazingCosine = 1e-3;

/// Rules that decide which hits of a shadow ray count: face culling by object, and double-precision tests of grazing
/// rays.
struct HitRules {
    std::span<const ObjectTraits> culls;  ///< one per object; empty: every face counts
    std::span<const ExactRay> exact;      ///< indexed by the ray's id; empty: no ray is grazing
};

/// Makes an Embree ray segment from `origin` to origin + length * direction.
/// @param id the caller's number of the ray; also the index in HitRules::exact, unless that span is empty
inline RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float length, unsigned id) {
    // In Embree's order: origin, nearest t, direction, time, farthest t, mask, id, flags.
    return {origin.x, origin.y, origin.z, 0, direction.x, direction.y, direction.z, 0, length, ~0u, id, 0};
}

/// Tests shadow rays for occlusion by casters. An occluded ray gets a negative `tfar`.
/// @param rays ray segments from make_ray(), in the scene's unit frame (UnitFrame: centred, about one unit long)
/// @param rules decide which hits count
void mark_occluded(const RayHierarchy& scene, std::span<RTCRay> rays, const HitRules& rules);

/// Intersection of a ray with a caster's triangle.
struct Hit {
    float t = 0;          ///< distance from the ray's origin, in lengths of its direction vector
    bool culled = false;  ///< true: face culling by HitRules::culls removes the hit face
    std::uint32_t object = 0;
    std::uint32_t primitive = 0;  ///< triangle within the object
};
/// Collects all intersections of a ray with casters up to the ray's end, in no order. Faces removed by culling are
/// included and marked (Hit::culled).
/// @param out receives the intersections
void collect_hits(const RayHierarchy& scene, const RTCRay& ray, const HitRules& rules, std::vector<Hit>& out);

}  // namespace si
