// Error over cost: every measured case a dot, the frontier as a stair, the present settings among them.
#pragma once

#include <imgui.h>

#include <optional>

#include "ui/panels/frontier_panel.h"

namespace si {

struct FrontierPlotResult {
    std::optional<std::size_t> hovered, clicked;  ///< index in SweepFacts::cases
    bool present_hovered = false;
};

/// Fills `size` pixels at the cursor; the caller names the axes. @param bytes what costs count @param chosen number of
/// a case to ring
FrontierPlotResult draw_frontier_plot(const SweepFacts& facts, bool bytes, std::optional<int> chosen, ImVec2 size);

}  // namespace si
