// A camera's frustum as lines: in the world, and in the map of a light.
#pragma once

#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/projection/light_view.h"

namespace si {

/// The twelve edges of what a camera sees, world: four of the near plane, four of the far plane, four between. A far
/// plane farther than twenty times the focus is drawn there.
std::vector<std::pair<glm::dvec3, glm::dvec3>> camera_edges(const Camera& camera);

/// The parts of those edges that lie in front of a light and inside its map, in map coordinates (0..1, v up).
std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_outline_in_map(const Camera& camera, const LightView& view);

/// The rim of all that the camera can see, in the same coordinates; of a map in perspective or a warped one its edges.
std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_region_in_map(const Camera& camera, const LightView& view);

}  // namespace si
