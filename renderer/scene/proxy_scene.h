// A small scene that is drawn by the programs of a large one, for whoever only wants those programs made.
#pragma once

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Of each kind of object (what its material, vertices and settings.objects call for) one, and those that reach
/// farthest out; of their meshes the triangles that do; of textures a few texels. Cameras and lights are the scene's,
/// bounds about those. A scene that is small keeps all its triangles.
Scene stand_in(const Scene& scene, const Settings& settings);

}  // namespace si
