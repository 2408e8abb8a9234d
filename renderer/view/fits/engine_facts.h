// Facts of a fitted light's map on which an engine's numbers depend.
#pragma once

#include "renderer/profiles/engine_profile.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns the size, depth range and format of one shadow map of a light. Engine profiles need these facts to convert
/// bias numbers. Width and texels are those of the longer side; in perspective the width is that in the middle of the
/// depth range.
/// @param size texels of the map
MapFacts map_facts(const LightView& view, const Settings& settings, MapSize size);
/// Returns the size, depth range and format of the first shadow map of a light. Engine profiles need these facts to
/// convert bias numbers. Without a map: the lengths of the worked example, with the format of the settings.
/// @param light null: none
/// @param size texels of its maps
MapFacts map_facts(const FittedLight* light, const Settings& settings, MapSize size);

}  // namespace si
