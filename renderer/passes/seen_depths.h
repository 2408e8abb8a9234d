// Measurement of the visible depth range, before a frame is planned.
#pragma once

#include <optional>

#include "renderer/frame/state.h"

namespace si {

/// Draws the camera's depth and reads back the nearest and farthest visible depth, metres. Returns nullopt when no
/// surface is visible. Used by light.depth_bounds sdsm.
/// @param[out] info report on the drawing
std::optional<DepthSpan> measure_visible_depths(FrameState& f, PassInfo& info);

}  // namespace si
