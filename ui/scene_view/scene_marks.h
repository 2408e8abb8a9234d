// Marks over the scene picture and the mouse on them, one source each: all marks (scene_marks.cpp), lights
// (light_gizmo.cpp), axes (gnomon.cpp), and the menu of an object (scene_menu.cpp).
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Draws all marks over the scene picture: selection, caster boxes, frozen camera, probe ray, captions and lights.
void draw_scene_marks(const PicturePainter& painter, const EditorState& state, const EditorFrame& frame);

/// Handles the mouse over lights: drags handles of the shown light, and shows another light by a click on its mark.
/// Call right after the picture's ImGui item. A press on a mark or handle sets state.viewport.press_taken.
void steer_lights(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Cancels the drag of a light's handle and restores the light. The mouse button may stay down.
void cancel_handle_drag(EditorState& state);

/// Draws marks and frusta of all lights, and the handles of the shown one, into the scene picture.
void draw_lights(const EditorState& state, const EditorFrame& frame, const PicturePainter& painter);

/// Handles the mouse over the gnomon (the world axes in a corner of the scene picture). Call right after the picture's
/// ImGui item. A press on the end of an axis sets state.viewport.press_taken.
void steer_gnomon(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Draws the gnomon: the world axes in a corner of the scene picture.
void draw_gnomon(const EditorState& state, const PicturePainter& painter);

/// Opens the context menu of the object under the mouse on a right click in the scene picture. Call right after the
/// picture's ImGui item. A drag with the right button flies instead.
void open_scene_menu(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Draws the context menu of the scene picture while it is open. Its items act on all selected objects.
void draw_scene_menu(EditorState& state, const EditorFrame& frame);

}  // namespace si
