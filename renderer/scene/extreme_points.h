// Outermost vertices of a scene, for framing it by the automatic camera.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Returns the outermost vertices of a scene along 64 directions, for framing by the automatic camera. Excludes the
/// floor and everything outside Scene::main_part. The points are in metres, in the scene's space before
/// Scene::placement is applied. The directions are spread evenly after scaling the scene's bounds to a cube. The hull
/// of the points misses peaks between directions, usually by some hundredths of the scene's size. Empty without a
/// finite vertex or with a singular placement.
std::vector<glm::dvec3> extreme_points(const Scene& scene);

/// Stores the outermost points and the bounds of the scene's present pose in Scene::framed and Scene::framed_bounds.
/// The automatic camera frames these from then on, so that it does not follow an animation.
void store_framing_points(Scene& scene);

}  // namespace si
