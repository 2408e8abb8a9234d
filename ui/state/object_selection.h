// Objects of the scene that are selected.
#pragma once

#include <set>
#include <string>

namespace si {

/// Node paths of the selected objects.
struct ObjectSelection {
    std::string first;             ///< the one selected first; empty: none is selected
    std::set<std::string> others;  ///< all but the first
};

}  // namespace si
