// Facts of a fitted light's map on which an engine's numbers depend.
#pragma once

#include "renderer/profiles/engine_profile.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns the facts of one map of a light. Width and texels are those of the longer side; in perspective the width is
/// that in the middle of the depth range.
MapFacts map_facts(const LightView& view, const Settings& settings, MapSize size);
/// Returns the facts of the first map of a light. Without a map: the facts of the worked example, with the settings'
/// texels and format.
/// @param light null: none @param size texels of its maps
MapFacts map_facts(const FittedLight* light, const Settings& settings, MapSize size);

}  // namespace si
