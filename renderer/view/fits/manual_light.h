// Conversion of a fitted light to manual settings.
#pragma once

#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns light settings in which all fitted values are written out (light.fit = manual): distance, near, far, extent
/// and place. fit_lights() then finds the same views within rounding. Used before the user changes one value by hand.
/// @param fitted the light, from fit_lights() with `settings`
LightSettings manual_light(const LightSettings& settings, const FittedLight& fitted);

/// Returns the world-space point to which the settings light.N.target_x, target_y and target_z are relative.
glm::dvec3 target_origin(const LightSettings& settings, const FittedLight& fitted);

}  // namespace si
