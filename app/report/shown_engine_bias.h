// Knowledge of the engine's bias of the light that a command measures.
#pragma once

#include <span>

#include "renderer/bundle/engine_bias.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Returns the knowledge of the bias with which an engine reads the maps of view.light; EngineBias::Own where the
/// program draws them. @param lights lights of the frame
EngineBias shown_engine_bias(const Settings& settings, std::span<const FittedLight> lights);

}  // namespace si
