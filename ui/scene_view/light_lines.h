// Outlines of the lights' frusta as lines of the scene picture.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/projection/light_view.h"

namespace si {

struct Segment {
    glm::dvec3 from{0}, to{0};  ///< world
    bool far = false;           ///< belongs to the far plane
};

/// The twelve edges of what a light's view covers, near plane to far plane.
std::vector<Segment> frustum_edges(const LightView& view);

/// The part of a segment in front of the camera, in pixels (0,0 at the top left); nothing when all is behind it.
std::optional<std::pair<glm::dvec2, glm::dvec2>> project_segment(const Camera& camera, glm::dvec3 from, glm::dvec3 to,
                                                                 int width, int height);

}  // namespace si
