// Keys that the editor takes from ImGui.
#pragma once

#include <array>

namespace si {

/// Owners of the arrow keys and the page keys, which ImGui uses for its own navigation.
struct KeyboardState {
    bool probe_has_arrows = false;            ///< the arrow keys move the probe, not the focus
    bool took_navigation = false;             ///< ImGui's keyboard navigation is off for that reason
    std::array<int, 2> page_keys = {-1, -1};  ///< window codes of Page up and Page down; -1: not known yet
};

}  // namespace si
