// Frusta of cameras and lights as lines: in the world, in a picture, and in the map of a light.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/projection/light_view.h"

namespace si {

/// Edge of a frustum as a line segment in world space.
struct Segment {
    glm::dvec3 from{0};  ///< world
    glm::dvec3 to{0};    ///< world
    bool far = false;    ///< edge of the far plane
};

/// Returns the twelve edges of a camera's frustum in world space, for drawing. The drawn far plane is at most twenty
/// times as far as the point that the camera looks at.
std::vector<Segment> camera_edges(const Camera& camera);

/// Returns the edges of a camera's frustum as line segments in a light's map, clipped to the map, in map coordinates
/// (0..1, v up).
std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_outline_in_map(const Camera& camera, const LightView& view);

/// Returns the outline of the part of a light's map that lies in a camera's frustum, as line segments in map
/// coordinates (0..1, v up). For perspective and warped maps it returns all edges of the frustum instead.
std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_region_in_map(const Camera& camera, const LightView& view);

/// Returns the twelve edges in world space of the frustum that one shadow map of a light covers, for drawing.
std::vector<Segment> frustum_edges(const LightView& view);

/// Projects a line segment in world space into a camera's picture, in pixels (0, 0 at the top left). Only the part in
/// front of the camera is projected. Returns nothing if all of the segment is behind the camera.
/// @param width, height size of the picture, pixels
std::optional<std::pair<glm::dvec2, glm::dvec2>> project_segment(const Camera& camera, glm::dvec3 from, glm::dvec3 to,
                                                                 int width, int height);

}  // namespace si
