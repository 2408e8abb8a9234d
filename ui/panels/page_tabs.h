// Tabs of the inspector and the strip: a tab of a bar, and the buttons of a tab with two pages.
#pragma once

#include <string>

#include "ui/state/window_layout.h"

namespace si {

/// State of a tab in this frame, as draw_tab() returns it.
struct DrawnTab {
    bool front = false;    ///< the tab bar shows the content of this tab
    bool pressed = false;  ///< pressed in this frame, by mouse or keyboard
};

/// Draws a tab of the current ImGui tab bar. Brings the tab to the front if it holds the page that is to be opened
/// (WindowState::open_page).
DrawnTab draw_tab(WindowState& window, Tab which, const std::string& label);
/// Returns true if a page is to be opened (WindowState::open_page) in the given part of the window.
/// @param in_inspector true: in the inspector on the right; false: in the strip below the pictures
bool is_page_awaited(const WindowState& window, bool in_inspector);
/// Returns true at a double click on a tab or the row of tabs; the caller then maximises the panel. Buttons beside the
/// tabs do not count. Call before ImGui::EndTabBar().
bool double_click_on_tabs();
/// Returns the width of the buttons that draw_page_buttons() draws for a tab, pixels; 0: the tab has one page.
float page_buttons_width(Tab which);
/// Draws a button for each page of a tab with several pages. A press shows the page.
void draw_page_buttons(WindowState& window, Tab which);

}  // namespace si
