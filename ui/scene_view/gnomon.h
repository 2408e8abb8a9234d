// Axes of the world in a corner of the scene picture. A click on an end looks along that axis.
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Handles the mouse over the gnomon (the world axes in a corner of the scene picture). Call right after the picture's
/// ImGui item. A press on the end of an axis sets state.viewport.press_taken.
void steer_gnomon(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Draws the gnomon: the world axes in a corner of the scene picture.
void draw_gnomon(const EditorState& state, const PicturePainter& painter);

}  // namespace si
