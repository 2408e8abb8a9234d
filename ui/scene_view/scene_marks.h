// Marks over the scene picture and the mouse on them, one source each: all marks (scene_marks.cpp), lights
// (light_gizmo.cpp), axes (gnomon.cpp), and the menu of an object (scene_menu.cpp).
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Draws all marks over the scene picture: selection, caster boxes, frozen camera, probe ray, captions and lights.
void draw_scene_marks(const PicturePainter& painter, const EditorState& state, const EditorFrame& frame);

/// Handles the mouse over the lights in the scene picture: drags handles of the shown light, and shows another light by
/// a click on its mark. Call right after the picture's ImGui item. A press on a mark or handle sets
/// state.viewport.press_taken.
void steer_lights(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Cancels the drag of a light's handle and restores the light as it was before. The mouse button may still be held.
void cancel_handle_drag(EditorState& state);

/// Draws the lights into the scene picture: marks and frusta of all, and the handles of the shown light.
void draw_lights(const EditorState& state, const EditorFrame& frame, const PicturePainter& painter);

/// Handles the mouse over the gnomon (the world axes in a corner of the scene picture). A press on the end of an axis
/// makes the camera look along it, and sets state.viewport.press_taken. Call right after the picture's ImGui item.
void steer_gnomon(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Draws the gnomon: the world axes in a corner of the scene picture.
void draw_gnomon(const EditorState& state, const PicturePainter& painter);

/// Opens the context menu of the object under the mouse at a right click in the scene picture. A drag with the right
/// button flies the camera instead. Call right after the picture's ImGui item.
void open_scene_menu(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Draws the context menu of an object in the scene picture while it is open. Its items act on all selected objects.
void draw_scene_menu(EditorState& state, const EditorFrame& frame);

}  // namespace si
