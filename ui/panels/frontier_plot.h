// Plot of error over cost, painted from its drawing (renderer/measure/frontier_drawing.h).
#pragma once

#include <imgui.h>

#include <optional>

#include "ui/panels/frontier_panel.h"

namespace si {

/// Dots of the frontier plot (error over cost) that the mouse hovers or has clicked in this frame.
struct FrontierPlotResult {
    std::optional<std::size_t> hovered;  ///< index in SweepFacts::cases
    std::optional<std::size_t> clicked;  ///< index in SweepFacts::cases
    std::optional<PlotSpot::Kind> hovered_spot;
};

/// Draws the plot of error over cost of a sweep's cases (combinations of settings), with the table of best cases below
/// if there is room. The caller draws the names of the axes and the sentence of knee_sentence(). Returns the dots under
/// the mouse.
/// @param chosen number of the case that gets a ring; none: no ring @param size size in pixels, from the ImGui cursor
FrontierPlotResult draw_frontier_plot(const SweepFacts& facts, std::optional<int> chosen, ImVec2 size);

}  // namespace si
