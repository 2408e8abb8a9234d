// Makes scenes of boxes without a loader, for tests of fits and cameras.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace si::test {

/// Opposite corners of an axis-aligned box, world metres.
struct BoxExtent {
    glm::dvec3 lo{-1};
    glm::dvec3 hi{1};
};

/// Makes a scene with one object per box, whose mesh is the box's two z faces. Bounds and matrices are set as
/// finalise() sets them.
/// @param offset world metres, added to every box
Scene box_scene(const std::vector<BoxExtent>& boxes, const glm::dvec3& offset = glm::dvec3(0));

/// Makes a ground slab of 80 x 80 m with 7 x 7 blocks of 2 x 3 x 2 m on its top.
/// @param at centre of the slab's top, world metres
/// @param thickness_m thickness of the slab
Scene blocks_on_ground(const glm::dvec3& at, double thickness_m);

}  // namespace si::test
