// How the panes of a split view share one picture.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/settings/settings.h"

namespace si {

/// Where each pane lies in a picture of several; the panes are of one size, with a gap between them. Pixels, row 0 at
/// the top.
struct PaneGrid {
    int columns = 1, rows = 1;
    int width = 0, height = 0;  ///< of each pane
    int gap = 0;                ///< between two panes
    int count() const { return columns * rows; }
    glm::ivec2 corner(int pane) const { return {pane % columns * (width + gap), pane / columns * (height + gap)}; }
    struct Place {
        int pane;
        glm::ivec2 pixel;  ///< of that pane
    };
    /// What lies at a pixel of the whole picture; nothing in a gap or outside.
    std::optional<Place> pane_at(glm::ivec2 pixel) const;
};

/// The grid of view.panes (a Panes value) in a picture of `width` x `height`. A pane is at least one pixel large.
PaneGrid pane_grid(Panes panes, int width, int height, int gap = 0);

}  // namespace si
