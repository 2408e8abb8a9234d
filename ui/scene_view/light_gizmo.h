// Lights in the scene picture: frusta and marks of all lights, handles of the shown one.
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Drags handles of the shown light, and chooses another light by a click on its mark. Call right after the picture's
/// item. Takes a press (state.viewport.press_taken) on either.
void steer_lights(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Cancels the drag under way and restores the light. The button may stay down.
void cancel_handle_drag(EditorState& state);

/// Draws all lights into the scene picture.
void draw_lights(const EditorState& state, const EditorFrame& frame, const PicturePainter& painter);

}  // namespace si
