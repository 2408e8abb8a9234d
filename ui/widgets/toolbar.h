// A row of widgets that never wraps: what has no room waits in a menu at its end.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace si {

class Toolbar {
public:
    /// In what is left of the present line. @param id of the menu
    /// @param kept_free at its right end, for others
    explicit Toolbar(const char* id, float kept_free = 0);
    /// The next widget stands that far from the one before.
    void space(float width) { space_ = width; }
    /// A widget as wide as told, in the row or, from the first on that has no room, in the menu.
    /// @param label stands before it; empty: it has one of its own
    /// @param draw draws it in the width that is given; 0: its own
    void item(const char* label, float width, std::function<void(float)> draw);
    /// A line of text, left out where it has no room.
    void title(const char* text);
    /// The menu's button, where something waits in it.
    void end();

private:
    struct Waiting {
        const char* label;
        float width;
        std::function<void(float)> draw;
    };
    bool fits(float width);

    const char* id_;
    float right_;  ///< of the row, on the screen
    bool first_ = true;
    float space_ = -1;  ///< below 0: as usual
    std::vector<Waiting> waiting_;
};

}  // namespace si
