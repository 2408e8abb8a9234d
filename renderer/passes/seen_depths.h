// Depths of all that the camera sees, measured before a frame has a plan.
#pragma once

#include <optional>

#include "renderer/frame/state.h"

namespace si {

/// Draws the camera's depth and reads back its bounds in metres; nothing: the camera sees nothing.
/// @param[out] info of the drawing
std::optional<DepthSpan> measure_visible_depths(FrameState& f, PassInfo& info);

}  // namespace si
