// Rays through a ReferenceScene. For the sources of this folder; others use trace_visibility() and its kin.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "renderer/reference/embree.h"
#include "renderer/reference/receivers.h"
#include "renderer/reference/truth_scene.h"

namespace si {

/// One casting object in the hierarchy; its geometry (or instance) has the caster's index as its id.
struct Caster {
    std::uint32_t object = 0;
    bool mirrored = false;  ///< flattened with a mirroring transform: its winding is turned
};

struct ReferenceScene::Impl : UnitFrame {
    HeldMemory held{"hierarchies of rays", 0};  ///< what Embree takes; first: the device tells of it to its end
    embree::Device device;
    std::vector<embree::Scene> meshes;  ///< of instanced meshes
    embree::Scene scene;
    std::vector<Caster> casters;
    const ReferenceGeometry* geometry = nullptr;
    double radius = 1;  ///< of the scene, unit lengths
    std::size_t triangles = 0, instances = 0;
};

/// A ray from a receiver that single precision cannot judge, as it leaves along the surface: hits are tested again in
/// double, without the receiver's own triangle.
struct ExactRay {
    glm::dvec3 origin{0}, direction{0};  ///< unit frame, unit length
    double length = 0;
    std::uint32_t object = 0, primitive = 0;
};
/// Cosine between surface and ray below which a ray needs to be exact.
inline constexpr double kGrazing = 1e-3;

/// Which hits count.
struct HitRules {
    std::span<const ObjectTraits> culls;  ///< by object; empty: every face counts
    std::span<const ExactRay> exact;      ///< by the ray's id; empty: none
};

/// From `origin` along `direction` for `length` times its length.
inline RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float length, unsigned id) {
    RTCRay ray;
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.tnear = 0;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.time = 0;
    ray.tfar = length;
    ray.mask = ~0u;
    ray.id = id;
    ray.flags = 0;
    return ray;
}

/// Marks occluded rays by a negative tfar.
void occlude(const ReferenceScene::Impl& scene, std::span<RTCRay> rays, const HitRules& rules);

struct Hit {
    float t = 0;          ///< in lengths of the ray's direction
    bool culled = false;  ///< by HitRules::culls
};
/// All hits up to the ray's end, culled ones too, in no order.
void all_hits(const ReferenceScene::Impl& scene, const RTCRay& ray, const HitRules& rules, std::vector<Hit>& out);

}  // namespace si
