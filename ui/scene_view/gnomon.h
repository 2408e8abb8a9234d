// Axes of the world in a corner of the scene picture. A click on an end looks along that axis.
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Handles the mouse over the axes. Call right after the picture's item. Takes a press (state.viewport.press_taken) on
/// the end of an axis.
void steer_gnomon(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Draws the axes.
void draw_gnomon(const EditorState& state, const PicturePainter& painter);

}  // namespace si
