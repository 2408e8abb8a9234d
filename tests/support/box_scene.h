// Scenes of boxes for tests of fits and cameras, made without any loader.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace si::test {

struct BoxExtent {
    glm::dvec3 lo{-1}, hi{1};
};

/// One object per box (the box's two z faces as triangles), moved by `offset`, finished as finalise() would.
Scene box_scene(const std::vector<BoxExtent>& boxes, const glm::dvec3& offset = glm::dvec3(0));

/// A ground of 80 m about `at`, so thick, with 7 x 7 blocks of 2 x 3 x 2 m on it.
Scene blocks_on_ground(const glm::dvec3& at, double thickness_m);

}  // namespace si::test
