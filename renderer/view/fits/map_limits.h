// What a shadow map cannot tell apart whatever its bias and filter: the limits of its format and of its resolution.
#pragma once

#include <string>
#include <vector>

#include "renderer/view/bounds/scene_shape.h"

namespace si {

/// Of the parts of the scene that the views hold. A scene that is flat as the light sees it has no depth to resolve.
/// @param resolution of the map
MapLimits map_limits(const SceneShape& shape, const std::vector<LightView>& views, MapFormat format, int resolution);

/// A sentence for each limit that holds, with a remedy. @param light index, of whom they tell
std::vector<std::string> map_limit_notes(const MapLimits& limits, int light);

}  // namespace si
