// Ground disc under a loaded model whose file has no floor, so that its shadow is visible.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Returns true when a scene has its own floor to receive shadows, so that it needs no ground disc. Such a scene is a
/// landscape, or has level surfaces without a roof at its bottom, on at least half of its ground plan.
bool has_level_surface(const Scene& scene);

/// Adds a ground disc under the scene in its present pose, wide enough for shadows of a light 45 degrees up. The disc
/// receives shadows, casts none, and is no part of Scene::bounds. Its mesh, material, node and object are the last in
/// their lists, so that remove_ground() can drop them. Does nothing when the scene is empty or already has a ground
/// disc. A scene with its own floor gets no disc; Scene::has_floor is set instead.
void add_ground(Scene& scene);

/// Removes the ground disc that add_ground() has added to the scene, if any.
void remove_ground(Scene& scene);

}  // namespace si
