// A file's own lights as settings.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Converts the lights of a scene's file to suggested settings, light.count and light.<i>.*, which replace the earlier
/// suggestions for lights but light.<i>.fit. Does nothing when the file has no lights.
/// Positions and directions are exact up to rounding. Brightness is relative: the brightest directional light gets 1,
/// and so does the brightest of the spot and point lights. Uses light_fit_bounds(), so call again after pose().
void suggest_lights(Scene& scene);

}  // namespace si
