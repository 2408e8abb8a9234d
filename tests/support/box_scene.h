// Makes small scenes without a loader.
#pragma once

#include <glm/glm.hpp>
#include <string>
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

/// Mesh of a grey scene.
struct GreyPart {
    std::string name;  ///< name of the mesh and its object
    Mesh mesh;
    glm::dmat4 place{1};  ///< transform to the scene
};

/// Makes a finalised scene of meshes with one grey material, one object each, in order.
Scene grey_scene(std::vector<GreyPart> parts);

/// Makes a scene of a floor of 12 x 12 m with a row of upright bars 1.6 m high, at slightly uneven distances.
/// @param width_m thickness of a bar @param step_m distance of neighbouring bars
Scene fence(int bars, double width_m, double step_m);

}  // namespace si::test
