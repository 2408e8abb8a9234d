// A small scene that is drawn by the programs of a large one, for whoever only wants those programs made.
#pragma once

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Of each kind of object (what its material, vertices and settings.objects call for) one, and those that reach the
/// scene's bounds; of their meshes the triangles that reach the bounds; of textures a few texels. Bounds, cameras and
/// lights are the scene's. A scene that is small comes back as it is, at rest.
Scene stand_in(const Scene& scene, const Settings& settings);

}  // namespace si
