// Bar of a light's cascades over camera depth, in their colours; its borders are dragged.
#pragma once

#include <imgui.h>

#include <span>

#include "renderer/frame/frame.h"
#include "renderer/settings/settings.h"

namespace si {

/// Moves the far end of one cascade of a light by new manual splits (light.split). The other cascades keep their ends.
/// @param drawn the light's settings in the frame from which `ends` was taken
/// @param ends far ends of all cascades, metres of camera depth
/// @param cascade index of the cascade to change, not the last @param metres its new far end; clamped between its
/// neighbours
void move_cascade_end(LightSettings& light, const LightSettings& drawn, std::span<const double> ends, int cascade,
                      double metres);

/// Draws the bar of the shown light's cascades over camera depth, whose borders the mouse drags, at the lower edge of a
/// picture. Draws nothing unless the cascades are chosen by depth and there is room.
/// @param drawn settings of the frame; null: the present ones
/// @param lo, room upper left corner and size of the picture, pixels of the screen
/// @param taken width of the legend's widgets left of the bar, pixels
void draw_cascade_bar(Settings& settings, const Settings* drawn, const FrameResult& result, ImVec2 lo, ImVec2 room,
                      float taken);

}  // namespace si
