// The menu of the object under the mouse in the scene picture.
#pragma once

#include "ui/scene_view/picture_view.h"
#include "ui/state/editor_ui.h"

namespace si {

/// A right button that was pressed and released in one place over the picture, which is the item drawn last, opens the
/// menu; a drag with it flies.
void open_scene_menu(EditorState& state, const EditorFrame& frame, const PictureView& view);
/// While it is open. What it changes it changes of all chosen objects.
void draw_scene_menu(EditorState& state, const EditorFrame& frame);

}  // namespace si
