// Main part of a scene: its bounds without what lies far from the rest. First pictures frame it.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace si {

/// Sets Scene::main_part: the bounds of a scene without objects and vertices far from the rest, for framing the first
/// picture. Empty when nothing is far. Call after finalise(), before Scene::placement is set.
/// The core of a scene is the box of the 1st to 99th percentiles of its triangles' corners along each axis. The main
/// part is cut along each axis on which the scene is longer than 20 times the core's longest side. Along such an axis
/// it extends beyond the core by at most the length of that side. If no axis is cut, the test is repeated with corners
/// weighted by area.
void set_main_part(Scene& scene);

/// Returns a sentence that names the object reaching farthest from the main part of a scene, with its distance. Empty
/// when all objects lie within the main part.
std::string far_objects_text(const Scene& scene);

/// Returns true when a scene loaded as y-up is probably z-up, for a warning. Its y extent is then 1 % to 25 % of the
/// larger of its x and z extents, and the lowest 5 % of its triangles' corners along z lie in one plane. A scene with a
/// floor on more than half of its ground plan counts as y-up.
bool looks_z_up(const Scene& scene);

}  // namespace si
