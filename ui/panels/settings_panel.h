// State of the tab Settings.
#pragma once

#include <functional>
#include <set>
#include <string>

namespace si {

/// State of the tab that lists all settings: search text, filter and unfolded groups.
struct SettingsPanel {
    std::string search;
    bool focus_search = false;                    ///< the next frame puts the keyboard into the search field
    bool only_changed = false;                    ///< lists only settings that differ from their defaults
    std::set<std::string, std::less<>> unfolded;  ///< groups that also list their rarely used settings
};

}  // namespace si
