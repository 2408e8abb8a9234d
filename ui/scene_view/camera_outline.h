// A camera's frustum as lines: in the world, and in the map of a light.
#pragma once

#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/projection/light_view.h"

namespace si {

/// Returns the twelve edges of a camera's frustum in world space. The far plane is at most at twenty times the distance
/// of the focus.
std::vector<std::pair<glm::dvec3, glm::dvec3>> camera_edges(const Camera& camera);

/// Returns the parts of the camera's frustum edges inside a light's map, in map coordinates (0..1, v up).
std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_outline_in_map(const Camera& camera, const LightView& view);

/// Returns the outline of the camera's frustum in map coordinates (0..1, v up). For perspective and warped maps it
/// returns all edges instead.
std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_region_in_map(const Camera& camera, const LightView& view);

}  // namespace si
