// Marks over the scene picture: boxes, the frozen camera, the ray to the probed pixel, captions.
#pragma once

#include "ui/scene_view/picture_painter.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Draws all marks over the scene picture: selection, caster boxes, frozen camera, probe ray, captions and lights.
void draw_scene_marks(const PicturePainter& painter, const EditorState& state, const EditorFrame& frame);

/// Draws the boxes of the selected objects (with the name of the first) and of the object hovered in the list.
void draw_selection(const PicturePainter& painter, const EditorState& state, const Scene& scene);
/// Draws the bounding boxes of casters that the light fit uses, at most kMaxBoxes.
void draw_caster_bounds(const PicturePainter& painter, const Scene& scene, const Settings& settings);
inline constexpr int kMaxBoxes = 2000;

/// Draws the frustum of the frozen camera, unless the view is the same.
void draw_frozen_camera(const PicturePainter& painter, const Camera& frozen);

/// Draws the ray from the shown light to the probed pixel: lit up to the occluder, shadowed behind it.
void draw_probe_ray(const PicturePainter& painter, const EditorState& state, const EditorFrame& frame);

/// Draws captions in the upper right corner: a frozen camera, the view through a light, the colours of the ray.
void draw_captions(const PicturePainter& painter, const EditorState& state, const EditorFrame& frame);

}  // namespace si
