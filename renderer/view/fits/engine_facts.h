// Facts of a fitted light's map on which an engine's numbers depend.
#pragma once

#include "renderer/profiles/engine_profile.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns width (metres), texels, depth range (metres) and format of one shadow map of a light. Used to convert bias
/// values from and to other engines (engine_profile.h). Width and texels are those of the longer side. In perspective
/// the width is that in the middle of the depth range.
/// @param size texels of the map
MapFacts map_facts(const LightView& view, const Settings& settings, MapSize size);
/// Returns width (metres), texels, depth range (metres) and format of a light's first shadow map. Used to convert bias
/// values from and to other engines (engine_profile.h). Without a map, width and depth are the defaults of MapFacts.
/// @param light null: there is no light
/// @param size texels of the light's maps
MapFacts map_facts(const FittedLight* light, const Settings& settings, MapSize size);

}  // namespace si
