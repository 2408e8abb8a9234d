// Two small plots under the map: how often each depth occurs, with the ends of the grey scale to drag, and how depth
// grows with distance.
#pragma once

#include <imgui.h>

#include <optional>

#include "ui/state/editor_ui.h"

namespace si {

/// Histogram of the shown depths over view.map's values. Black and white (or the two thresholds of the band view) are
/// dragged in it. Fills `size` pixels at the cursor.
void draw_histogram(EditorState& state, const EditorFrame& frame, ImVec2 size);

/// Stored depth over distance, with the band thresholds and the distances they lie at; `marked_m` is a distance to
/// mark. Fills `size` pixels at the cursor.
void draw_depth_curve(const EditorState& state, const FrameResult& result, std::optional<double> marked_m, ImVec2 size);

/// Distance along the axis at which depth, counted from the near plane, reaches `share` of its range.
double distance_at_share(const DepthCurve& curve, double share);

}  // namespace si
