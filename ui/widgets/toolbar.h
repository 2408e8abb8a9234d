// Row of widgets that never wraps. Widgets without room move into a menu at its end.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace si {

/// Toolbar: a row of widgets that never wraps. Widgets without room move into a menu at its end.
class Toolbar {
public:
    /// Starts a toolbar, a row of widgets in the rest of the current line.
    /// @param id ImGui id of the menu at the toolbar's end, for widgets without room
    /// @param free_right width to leave free at the right end of the line, pixels
    explicit Toolbar(const char* id, float free_right = 0);
    /// Sets the gap before the next widget, pixels.
    void space(float width) { space_ = width; }
    /// Adds a widget to the toolbar. The first widget without room and all after it go into the menu at the end.
    /// @param label text before the widget; empty: none @param width width of the widget, pixels
    /// @param draw function that draws the widget; its argument is the widget's width, pixels
    void item(const char* label, float width, std::function<void(float)> draw);
    /// Draws a title as the toolbar's next widget if it fits, else leaves it out.
    void title(const char* text);
    /// Ends the toolbar: draws the button of the menu, if some widgets had no room.
    void end();

private:
    /// Widget that has no room in the toolbar; the menu at the toolbar's end draws it.
    struct Waiting {
        const char* label;
        float width;
        std::function<void(float)> draw;
    };
    /// Moves the cursor behind the last widget of the toolbar. Returns true if a widget of `width` pixels fits there.
    /// Returns false once an earlier widget has moved into the menu at the toolbar's end.
    bool fits(float width);

    const char* id_;
    float right_;  ///< right end of the row, pixels of the screen
    bool first_ = true;
    float space_ = -1;  ///< gap before the next widget, pixels; below 0: the usual one
    std::vector<Waiting> waiting_;
};

}  // namespace si
