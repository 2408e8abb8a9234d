// Limits of a shadow map that no bias or filter can overcome: too coarse a depth format or resolution.
#pragma once

#include <string>
#include <vector>

#include "renderer/view/bounds/scene_shape.h"

namespace si {

/// Tests whether the depth range of the scene falls into one step of the map format, or the scene into one texel. Flat
/// scenes are not tested for depth.
/// @param resolution texels a side of the map
MapLimits map_limits(const SceneShape& shape, const std::vector<LightView>& views, MapFormat format, int resolution);

/// Returns warnings to the user, one sentence for each limit that applies, with a fix.
/// @param light index of the light, for the text
std::vector<std::string> map_limit_notes(const MapLimits& limits, int light);

}  // namespace si
