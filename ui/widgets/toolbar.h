// Row of widgets that never wraps. Widgets without room move into a menu at its end.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace si {

/// Layout of one row.
class Toolbar {
public:
    /// Starts a row in the free part of the line. @param id of the menu @param free_right pixels at its right end
    explicit Toolbar(const char* id, float free_right = 0);
    /// Sets the gap before the next widget, pixels.
    void space(float width) { space_ = width; }
    /// Adds a widget to the row; after the first one without room all go into the menu.
    /// @param label text before it; empty: none @param width pixels
    /// @param draw draws the widget in a given width; 0: in its own
    void item(const char* label, float width, std::function<void(float)> draw);
    /// Draws a title, unless it has no room.
    void title(const char* text);
    /// Draws the menu's button, if there is something in the menu.
    void end();

private:
    struct Waiting {
        const char* label;
        float width;
        std::function<void(float)> draw;
    };
    bool fits(float width);

    const char* id_;
    float right_;  ///< right end of the row, pixels of the screen
    bool first_ = true;
    float space_ = -1;  ///< gap before the next widget, pixels; below 0: the usual one
    std::vector<Waiting> waiting_;
};

}  // namespace si
