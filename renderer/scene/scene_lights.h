// A file's own lights as settings.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Puts Scene::lights into Scene::suggested as light.count and light.<i>.*, in place of what it held of lights; nothing
/// when there are no lights. Places and directions are exact up to rounding. Brightness: the settings' own scale, on
/// which the brightest directional light is 1, and spot and point lights keep their ratios (the fit scales them
/// together). Uses Scene::bounds, so call it again after pose().
void suggest_lights(Scene& scene);

}  // namespace si
