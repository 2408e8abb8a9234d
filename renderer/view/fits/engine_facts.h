// Facts of a fitted light's map on which an engine's numbers depend.
#pragma once

#include "renderer/profiles/engine_profile.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns the facts of the first map of a light. In perspective the width is that in the middle of the depth range.
/// Without a map: the facts of the worked example, with the settings' texels and format.
/// @param light null: none
MapFacts map_facts(const FittedLight* light, const Settings& settings);

}  // namespace si
