// Frusta of lights as line segments.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/projection/light_view.h"

namespace si {

/// Line segment of a light's frustum, world.
struct Segment {
    glm::dvec3 from{0};  ///< world
    glm::dvec3 to{0};    ///< world
    bool far = false;    ///< edge of the far plane
};

/// Returns the twelve edges of a light view's frustum, world.
std::vector<Segment> frustum_edges(const LightView& view);

/// Projects a world segment into a camera's picture: the part in front of the camera, in pixels (0, 0 at the top left).
/// Returns nothing if all of the segment is behind the camera. @param width, height pixels
std::optional<std::pair<glm::dvec2, glm::dvec2>> project_segment(const Camera& camera, glm::dvec3 from, glm::dvec3 to,
                                                                 int width, int height);

}  // namespace si
