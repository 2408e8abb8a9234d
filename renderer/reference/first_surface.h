// Distances from a light to the first caster along given rays: the content of an ideal shadow map.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/reference/reference_scene.h"

namespace si {

/// Ray segment that starts at a light, in world space, metres.
struct LightRaySegment {
    glm::dvec3 from_ws{0}, to_ws{0};
};

/// Traces ray segments from a light to the first caster, without face culling. Returns for each segment the distance
/// from its start in metres; NaN without a hit. The precision is that of 32-bit floats, relative to the segment's
/// length and the scene's size.
std::vector<double> first_caster_distances(const ReferenceScene& scene, std::span<const LightRaySegment> segments);

/// First caster that a ray segment from a light hits.
struct FirstCaster {
    double distance_m = 0;     ///< metres along the segment
    std::uint32_t object = 0;  ///< index in Scene::objects
    glm::dvec3 normal_ws{0};   ///< unit normal of the triangle by its winding; 0 for a triangle without area
};

/// Traces ray segments from a light to the first caster that face culling keeps in the shadow map. The precision is
/// that of 32-bit floats, as in first_caster_distances().
/// @param traits shadow settings of each object, see object_traits()
/// @return one per segment; nullopt without a hit
/// @throws Cancelled
std::vector<std::optional<FirstCaster>> first_casters(const ReferenceScene& scene,
                                                      std::span<const LightRaySegment> segments,
                                                      std::span<const ObjectTraits> traits,
                                                      const Workers& workers = {});

}  // namespace si
