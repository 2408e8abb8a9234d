// Limits of a shadow map that no bias or filter can overcome: too coarse a depth format or resolution.
#pragma once

#include <string>
#include <vector>

#include "renderer/view/bounds/scene_shape.h"

namespace si {

/// Tests whether a light's shadow maps are too coarse for any bias: whether all depths of the scene fall into one step
/// of the map format, or the scene into one texel. Views along which the scene is flat are not tested.
/// @param views views of the light
/// @param resolution texels along a side of the map
MapLimits map_limits(const SceneShape& shape, const std::vector<LightView>& views, MapFormat format, int resolution);

/// Returns warnings to the user about shadow maps that are too coarse: one sentence for each limit that applies, with a
/// fix.
/// @param light index of the light, for the text
std::vector<std::string> map_limit_notes(const MapLimits& limits, int light);

}  // namespace si
