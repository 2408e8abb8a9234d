// Main part of a scene: its bounds without what lies far from the rest. First pictures frame it.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace si {

/// Sets Scene::main_part: the bounds without objects and vertices far from the rest, or empty when nothing is far. Call
/// after finalise(), before Scene::placement is set. The core of a scene is the box of the 1st to 99th percentiles of
/// its triangles' corners along each axis. Along an axis on which the scene is more than 20 times as long as the core's
/// longest side, the main part is what lies within that side of the core. Where no axis is, corners count by area.
void set_main_part(Scene& scene);

/// Returns a sentence that names the object that reaches farthest from the main part of a scene; empty when nothing
/// does.
std::string far_objects_text(const Scene& scene);

/// Returns true when a scene looks as if z were its up axis: its height is below a quarter of its width or depth, and
/// the lowest 5 % of its triangles' corners along z lie in one plane. A scene with a floor, which covers more than half
/// of its ground plan, looks y-up.
bool looks_z_up(const Scene& scene);

}  // namespace si
