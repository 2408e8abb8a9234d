// The lights in the scene picture: frusta and marks of all, handles of the shown one.
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Lets the mouse drag a handle of the shown light, or choose another light by its mark. Call right after the picture's
/// item; takes a press (state.viewport.press_taken) that is on either.
void steer_lights(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Gives the light back as it was before the drag, which is under way. The button may stay down.
void cancel_handle_drag(EditorState& state);

void draw_lights(const EditorState& state, const EditorFrame& frame, const PicturePainter& painter);

}  // namespace si
