// Two plots under the map: histogram of depths with the draggable ends of the grey scale, and depth over distance.
#pragma once

#include <imgui.h>

#include <optional>

#include "ui/state/editor_ui.h"

namespace si {

/// Draws the histogram of depths of the image in the map viewer. The user can drag the two depths that are shown as
/// black and white. In the view by three bands of depth, the limits between the bands are dragged instead.
/// @param size size of the plot in pixels, from the ImGui cursor
void draw_histogram(EditorState& state, const EditorFrame& frame, ImVec2 size);

/// Draws the plot of depth-buffer value over distance along the view's axis, for the image in the map viewer. Two
/// lines mark view.band_low and view.band_high, the depths at which the view by bands changes its colour.
/// @param marked_m distance to mark with a dot, metres; none: no dot @param size size of the plot in pixels, from the
/// ImGui cursor
void draw_depth_curve(const EditorState& state, const FrameResult& result, std::optional<double> marked_m, ImVec2 size);

/// Returns the distance along the view's axis, in metres, at which the depth-buffer value is `share` of the way from
/// the near to the far plane.
/// @param share 0 at the near plane, 1 at the far plane, for reversed depth too
double distance_at_share(const DepthCurve& curve, double share);

}  // namespace si
