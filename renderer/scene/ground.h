// Ground disc under a loaded model whose file has no floor, so that its shadow is visible.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Returns true when the scene has its own floor for shadows: a landscape, or level surfaces at the bottom without a
/// roof, over most of its width.
bool has_level_surface(const Scene& scene);

/// Adds a ground disc under the scene in its present pose, wide enough for shadows of a light 45 degrees up. It
/// receives shadows, casts none, and is no part of Scene::bounds. Its mesh, material, node and object are the last in
/// their lists, so that remove_ground() can drop them. Adds nothing when the scene has a ground or a floor or is empty.
/// Sets Scene::has_floor when the scene has a floor.
void add_ground(Scene& scene);

/// Removes the ground disc that add_ground() added, if any.
void remove_ground(Scene& scene);

}  // namespace si
