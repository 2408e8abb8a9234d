// What of the scene lies under the mouse.
#pragma once

#include <string>

#include "renderer/scene/scene.h"
#include "ui/scene_view/picture_view.h"

namespace si {

/// The path of the node whose triangle the ray meets first, whichever side it shows; holes of masked materials count as
/// solid. Empty when it meets none. Takes time in proportion to the triangles of the objects whose boxes it meets.
std::string object_at(const Scene& scene, const Ray& ray);

}  // namespace si
