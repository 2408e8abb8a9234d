// Context menu of the object under the mouse in the scene picture.
#pragma once

#include "ui/scene_view/picture_view.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Opens the context menu of the object under the mouse on a right click in the scene picture. Call right after the
/// picture's ImGui item. A drag with the right button flies instead.
void open_scene_menu(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// Draws the context menu of the scene picture while it is open. Its items act on all selected objects.
void draw_scene_menu(EditorState& state, const EditorFrame& frame);

}  // namespace si
