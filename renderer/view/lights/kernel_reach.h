// How far a kernel reaches under one light: by its settings, and where it follows metres or the light's size, by its
// map.
#pragma once

#include "renderer/settings/filters.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Radius in texels of the widest penumbra that the light can throw in its maps: from their near to their far planes.
double max_penumbra_radius_texels(const FittedLight& light, int resolution);

/// Least width of a texel in the light's maps, metres.
double smallest_texel_m(const FittedLight& light, int resolution);

/// reach_of() under a light that casts.
Reach kernel_reach_in_light(const Settings& settings, const FittedLight& light, int resolution);

}  // namespace si
