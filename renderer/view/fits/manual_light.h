// A light's fitted map written out as settings by hand, so that one part of it can be moved and the rest stays.
#pragma once

#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// `settings` with everything that the fit chose (distance, near, far, extent, for directional lights the place)
/// written out under light.fit = manual: fit_lights() then finds the same views within rounding. Settings that leave
/// nothing to the fit come back as they are.
/// @param fitted what fit_lights() made of `settings`
LightSettings manual_light(const LightSettings& settings, const FittedLight& fitted);

/// What light.N.target_x, y, z count from, world.
glm::dvec3 target_origin(const LightSettings& settings, const FittedLight& fitted);

}  // namespace si
