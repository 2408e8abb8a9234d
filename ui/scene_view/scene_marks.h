// What is drawn over the scene picture besides the lights: boxes, the frozen camera, the ray to the probed pixel,
// words.
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// All marks that belong over a picture of the scene: those below and the lights.
void draw_scene_marks(const PicturePainter& painter, const EditorState& state, const EditorFrame& frame);

/// The boxes of the selected objects with the first one's name, and of the row of the list under the mouse.
void draw_selection(const PicturePainter& painter, const EditorState& state, const Scene& scene);
/// The boxes of what casts, as the light fit sees them; at most kMostBoxes.
void draw_caster_bounds(const PicturePainter& painter, const Scene& scene, const Settings& settings);
inline constexpr int kMostBoxes = 2000;

/// The frustum of the frozen camera, unless the view is still the same.
void draw_frozen_camera(const PicturePainter& painter, const Camera& frozen);

/// The ray from the shown light to the probed pixel: lit up to the occluder, shadowed behind it.
void draw_probe_ray(const PicturePainter& painter, const EditorState& state, const EditorFrame& frame);

/// What is out of the ordinary about the picture, in its upper right corner: a frozen camera, the view through a light,
/// the colours of the ray.
void draw_captions(const PicturePainter& painter, const EditorState& state, const EditorFrame& frame);

}  // namespace si
