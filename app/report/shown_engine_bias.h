// Knowledge of the engine's bias of the light that a command measures.
#pragma once

#include <span>

#include "renderer/bundle/engine_bias.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns what is known about the bias with which another engine reads its shadow maps of the light that view.light
/// selects. It may come from the engine's file, be entered by the user, changed, or unknown. Returns EngineBias::Own if
/// this program draws the maps.
/// @param lights lights of the frame
EngineBias shown_engine_bias(const Settings& settings, std::span<const FittedLight> lights);

}  // namespace si
