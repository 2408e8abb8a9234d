// Two plots under the map: histogram of depths with the draggable ends of the grey scale, and depth over distance.
#pragma once

#include <imgui.h>

#include <optional>

#include "ui/state/editor_ui.h"

namespace si {

/// Draws the histogram of the shown map's depths. The mouse drags the ends of the grey scale (or the thresholds of the
/// band view) in it. @param size the size in pixels, counted from the cursor
void draw_histogram(EditorState& state, const EditorFrame& frame, ImVec2 size);

/// Draws the curve of stored depth over distance from the light, with the band thresholds. @param marked_m the distance
/// to mark, metres @param size the size in pixels, counted from the cursor
void draw_depth_curve(const EditorState& state, const FrameResult& result, std::optional<double> marked_m, ImVec2 size);

/// Returns the distance along the view axis, metres, at which stored depth reaches `share` of its range, counted from
/// the near plane.
double distance_at_share(const DepthCurve& curve, double share);

}  // namespace si
