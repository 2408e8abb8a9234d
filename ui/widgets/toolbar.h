// Row of widgets that never wraps. Widgets without room move into a menu at its end.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace si {

/// Toolbar: a row of widgets that never wraps. Widgets without room move into a menu at its end.
class Toolbar {
public:
    /// Starts a row in the free part of the line. @param id of the menu @param free_right pixels at its right end
    explicit Toolbar(const char* id, float free_right = 0);
    /// Sets the gap before the next widget, pixels.
    void space(float width) { space_ = width; }
    /// Adds a widget to the toolbar. From the first widget without room on, all go into the menu at the end.
    /// @param label text before it; empty: none @param width pixels
    /// @param draw draws the widget in a given width; 0: in its own
    void item(const char* label, float width, std::function<void(float)> draw);
    /// Draws a title in the toolbar, if it has room.
    void title(const char* text);
    /// Ends the toolbar: draws the button of the menu, if some widgets had no room.
    void end();

private:
    /// Widget without room, which waits for the menu.
    struct Waiting {
        const char* label;
        float width;
        std::function<void(float)> draw;
    };
    /// Returns true if a widget of `width` pixels still fits into the row.
    bool fits(float width);

    const char* id_;
    float right_;  ///< right end of the row, pixels of the screen
    bool first_ = true;
    float space_ = -1;  ///< gap before the next widget, pixels; below 0: the usual one
    std::vector<Waiting> waiting_;
};

}  // namespace si
