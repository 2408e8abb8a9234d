// Marks over the scene picture: boxes, the frozen camera, the ray to the probed pixel, captions.
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Draws all marks over the scene picture: selection, caster boxes, frozen camera, probe ray, captions and lights.
void draw_scene_marks(const PicturePainter& painter, const EditorState& state, const EditorFrame& frame);

}  // namespace si
