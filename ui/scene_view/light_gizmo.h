// Lights in the scene picture: frusta and marks of all lights, handles of the shown one.
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Handles the mouse over lights: drags handles of the shown light, and shows another light by a click on its mark.
/// Call right after the picture's ImGui item. A press on a mark or handle sets state.viewport.press_taken.
void steer_lights(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Cancels the drag of a light's handle and restores the light. The mouse button may stay down.
void cancel_handle_drag(EditorState& state);

/// Draws marks and frusta of all lights, and the handles of the shown one, into the scene picture.
void draw_lights(const EditorState& state, const EditorFrame& frame, const PicturePainter& painter);

}  // namespace si
