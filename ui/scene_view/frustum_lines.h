// Frusta of cameras and lights as lines: in the world, in a picture, and in the map of a light.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/projection/light_view.h"

namespace si {

/// Edge of a frustum, world.
struct Segment {
    glm::dvec3 from{0};  ///< world
    glm::dvec3 to{0};    ///< world
    bool far = false;    ///< edge of the far plane
};

/// Returns the twelve edges of a camera's frustum in world space. The far plane is at most at twenty times the distance
/// of the focus.
std::vector<Segment> camera_edges(const Camera& camera);

/// Returns the parts of the camera's frustum edges inside a light's map, in map coordinates (0..1, v up).
std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_outline_in_map(const Camera& camera, const LightView& view);

/// Returns the outline of the camera's frustum in map coordinates (0..1, v up). For perspective and warped maps it
/// returns all edges instead.
std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_region_in_map(const Camera& camera, const LightView& view);

/// Returns the twelve edges of a light view's frustum, world.
std::vector<Segment> frustum_edges(const LightView& view);

/// Projects a world segment into a camera's picture: the part in front of the camera, in pixels (0, 0 at the top left).
/// Returns nothing if all of the segment is behind the camera. @param width, height pixels
std::optional<std::pair<glm::dvec2, glm::dvec2>> project_segment(const Camera& camera, glm::dvec3 from, glm::dvec3 to,
                                                                 int width, int height);

}  // namespace si
