// Plot of error over cost: a dot a case, the frontier as a stair, and the present settings.
#pragma once

#include <imgui.h>

#include <optional>

#include "ui/panels/frontier_panel.h"

namespace si {

/// Dots of the frontier plot that the mouse hovers or has clicked in this frame.
struct FrontierPlotResult {
    std::optional<std::size_t> hovered;  ///< index in SweepFacts::cases
    std::optional<std::size_t> clicked;  ///< index in SweepFacts::cases
    bool present_hovered = false;
};

/// Draws the frontier plot. The caller draws the names of the axes. Returns its mouse input. @param bytes true: costs
/// are bytes
/// @param chosen the number of the case that gets a ring @param size the size in pixels, counted from the cursor
FrontierPlotResult draw_frontier_plot(const SweepFacts& facts, bool bytes, std::optional<int> chosen, ImVec2 size);

}  // namespace si
