// Knowledge of the engine's bias of the light that a command measures.
#pragma once

#include <span>

#include "renderer/bundle/engine_bias.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns whether the bias with which another engine reads its shadow maps is known, and from which source, for the
/// light that view.light selects. Returns EngineBias::Own if this program draws the maps.
/// @param lights lights of the frame
EngineBias shown_engine_bias(const Settings& settings, std::span<const FittedLight> lights);

}  // namespace si
