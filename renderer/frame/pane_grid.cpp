#include "renderer/frame/pane_grid.h"

#include <algorithm>

#include "renderer/settings/settings.h"

namespace si {

std::optional<PaneGrid::Place> PaneGrid::pane_at(glm::ivec2 pixel) const {
    for (int pane = 0; pane < count(); ++pane) {
        const glm::ivec2 p = pixel - corner(pane);
        if (p.x >= 0 && p.y >= 0 && p.x < width && p.y < height) return Place{pane, p};
    }
    return std::nullopt;
}

PaneGrid pane_grid(Panes panes, int width, int height, int gap) {
    PaneGrid grid;
    grid.columns = panes == Panes::One ? 1 : 2;
    grid.rows = panes == Panes::Four ? 2 : 1;
    grid.gap = gap;
    grid.width = std::max(1, (width - gap * (grid.columns - 1)) / grid.columns);
    grid.height = std::max(1, (height - gap * (grid.rows - 1)) / grid.rows);
    return grid;
}

}  // namespace si
