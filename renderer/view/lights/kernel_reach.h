// Reach of the filter kernel in texels under one light.
#pragma once

#include "renderer/settings/filters.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns the radius in texels of the widest penumbra in a light's maps: of an occluder at the near plane on a
/// receiver at the far plane.
/// @param size texels of the map
double max_penumbra_radius_texels(const FittedLight& light, MapSize size);

/// Returns the width in metres of the smallest texel in a light's maps.
/// @param size texels of the map
double smallest_texel_m(const FittedLight& light, MapSize size);

/// Returns the reach of the filter kernel in texels under one light. Kernels sized in metres or by the light's size
/// depend on the light's maps; for a light that does not cast the result is reach_of() of the settings.
/// @param size texels of the map
Reach kernel_reach_in_light(const Settings& settings, const FittedLight& light, MapSize size);

/// Returns the distance in texels within which a true edge may change a light's shadow test: the reach of the kernel
/// and of the depth blur (map.blur_texels); 0 for a light without a map.
/// @param size texels of the map
double edge_reach_texels(const Settings& settings, const FittedLight& light, MapSize size);

}  // namespace si
