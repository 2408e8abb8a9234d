// What of a scene's surfaces lies outermost, for framing it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Vertices of what Scene::standing is about, before Scene::placement (metres): the outermost ones along 64 directions,
/// spread over all as if what stands were as wide as high and deep. Their hull lacks peaks between those: usually some
/// hundredths of its size. None where there is no finite vertex, or the placement cannot be undone.
std::vector<glm::dvec3> extreme_points(const Scene& scene);

/// Has the automatic camera frame from now on what stands there as the scene is: sets Scene::framed and its bounds.
void store_framing_points(Scene& scene);

}  // namespace si
