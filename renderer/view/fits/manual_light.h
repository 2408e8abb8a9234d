// Conversion of a fitted light to manual settings.
#pragma once

#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns light settings with all fitted values written out under light.fit = manual: distance, near, far, extent and
/// place. fit_lights() then finds the same views within rounding. Use it before the user changes one value by hand.
/// @param fitted fit_lights() of `settings`
LightSettings manual_light(const LightSettings& settings, const FittedLight& fitted);

/// Returns the world-space point to which light.N.target_x, target_y and target_z are relative.
glm::dvec3 target_origin(const LightSettings& settings, const FittedLight& fitted);

}  // namespace si
