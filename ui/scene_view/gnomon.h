// The axes of the world in a corner of the scene picture; a click looks along one.
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Call right after the picture's item; takes a press (state.viewport.press_taken) on the end of an axis.
void steer_gnomon(EditorState& state, const EditorFrame& frame, const PictureView& view);
void draw_gnomon(const EditorState& state, const PicturePainter& painter);

}  // namespace si
