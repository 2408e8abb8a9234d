// Distances from a light to the first caster along given rays: the content of an ideal shadow map.
#pragma once

#include <span>
#include <vector>

#include "renderer/reference/reference_scene.h"

namespace si {

/// Ray segment that starts at a light, in world space, metres.
struct LightRaySegment {
    glm::dvec3 from_ws{0}, to_ws{0};
};

/// Traces ray segments from a light to the first caster, whichever side it shows. Returns metres along each segment;
/// NaN without a hit. Relative precision is that of 32-bit floats, of the segment's length and the scene's size.
std::vector<double> first_caster_distances(const ReferenceScene& scene, std::span<const LightRaySegment> segments);

}  // namespace si
