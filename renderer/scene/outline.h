// What of a scene's surfaces lies outermost, for framing it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

/// Vertices of what Scene::standing is about, before Scene::placement (metres): the outermost ones along 64 directions,
/// which are spread as evenly over all of them as what stands is wide, high and deep. Their hull is its own within some
/// hundredths of its size. None where there is no finite vertex, or the placement cannot be undone.
std::vector<glm::dvec3> outermost_points(const Scene& scene);

}  // namespace si
