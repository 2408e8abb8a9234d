// State of the list of objects, and the selected objects.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace si {

/// State of the list of objects, a tree of the scene's nodes.
struct ObjectsPanel {
    std::string search;
    bool only_lost = false;              ///< lists only casters that the map loses
    std::string sought;                  ///< node path selected elsewhere, to scroll to; empty: none
    int scroll_frames = 0;               ///< frames left in which the list scrolls to it
    std::string hovered;                 ///< node path of the row under the mouse; empty: none
    std::set<std::string> closed_nodes;  ///< node paths whose children are folded away
    std::vector<double> ranks;           ///< sort values of the nodes of the scene `ranks_scene`, one for each node
    std::uint64_t ranks_scene = 0;       ///< Scene::id
};

/// Node paths of the selected objects.
struct ObjectSelection {
    std::string first;             ///< the one selected first; empty: none is selected
    std::set<std::string> others;  ///< all but the first
};

}  // namespace si
