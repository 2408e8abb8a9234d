// Picking of scene objects by rays.
#pragma once

#include <string>

#include "renderer/scene/scene.h"
#include "ui/scene_view/picture_view.h"

namespace si {

/// Returns the node path of the object whose triangle a ray hits first; empty: none. Both sides of triangles count, and
/// holes of masked materials are solid. The time is proportional to the triangles of objects whose boxes the ray hits.
std::string object_at(const Scene& scene, const Ray& ray);

}  // namespace si
