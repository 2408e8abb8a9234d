// Reach of the filter kernel in texels under one light.
#pragma once

#include "renderer/settings/filters.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns the radius in texels of the widest penumbra that can occur in a light's shadow maps: that of an occluder at
/// the near plane on a receiver at the far plane.
/// @param size texels of the map
double max_penumbra_radius_texels(const FittedLight& light, MapSize size);

/// Returns the width in metres of the smallest texel in a light's shadow maps. Used to convert the radius of a kernel
/// (filter.radius) from metres to texels.
/// @param size texels of the map
double smallest_texel_m(const FittedLight& light, MapSize size);

/// Returns how far the filter kernel looks from its centre under one light, in texels. For kernels sized in metres or
/// by the light's size this depends on the light's maps. If the light has no shadow map, returns reach_of() of the
/// settings.
/// @param size texels of the map
Reach kernel_reach_in_light(const Settings& settings, const FittedLight& light, MapSize size);

/// Returns the distance in texels within which a true shadow edge may change the result of a light's shadow test: reach
/// of the kernel plus depth blur (map.blur_texels); 0 for a light without a map.
/// @param size texels of the map
double edge_reach_texels(const Settings& settings, const FittedLight& light, MapSize size);

}  // namespace si
