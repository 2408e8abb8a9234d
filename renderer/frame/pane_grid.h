// Layout of the split view's panes in one picture.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/settings/settings.h"

namespace si {

/// Layout of the split view: columns and rows of equally large panes in one picture, with a gap between them. All sizes
/// are in pixels; row 0 is the top.
struct PaneGrid {
    int columns = 1, rows = 1;
    int width = 0, height = 0;  ///< size of each pane
    int gap = 0;                ///< between two panes
    /// Returns the number of panes in the split view.
    int count() const { return columns * rows; }
    /// Returns the upper left pixel of a pane of the split view in the whole picture.
    glm::ivec2 corner(int pane) const { return {pane % columns * (width + gap), pane / columns * (height + gap)}; }
    /// Index of a pane of the split view, and a pixel counted within that pane.
    struct Place {
        int pane;
        glm::ivec2 pixel;  ///< position within the pane
    };
    /// Finds the pane of the split view that contains a pixel of the whole picture. Returns the pane and the pixel
    /// counted within it; nullopt in a gap or outside all panes.
    std::optional<Place> pane_at(glm::ivec2 pixel) const;
};

/// Computes the layout of the split view (view.panes) in a picture of `width` x `height` pixels. Each pane is at least
/// one pixel large.
/// @param gap pixels between two panes
PaneGrid pane_grid(Panes panes, int width, int height, int gap = 0);

}  // namespace si
