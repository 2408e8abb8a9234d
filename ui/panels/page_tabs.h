// Tabs of the inspector and the strip: a tab of a bar, and the buttons of a tab with two pages.
#pragma once

#include <string>

#include "ui/state/window_layout.h"

namespace si {

/// State of a drawn tab.
struct DrawnTab {
    bool front = false;    ///< its bar shows this tab
    bool pressed = false;  ///< pressed in this frame, by mouse or keyboard
};

/// Draws a tab of the current tab bar. Brings the tab to the front if WindowState::open_page is one of its pages.
DrawnTab draw_tab(WindowState& window, Tab which, const std::string& label);
/// Returns true if WindowState::open_page is a page of the inspector (or else of the strip).
bool is_page_awaited(const WindowState& window, bool in_inspector);
/// Returns true at a double click on a tab or the row of tabs, except on the arrows that scroll the tabs. Call before
/// ImGui::EndTabBar().
bool double_click_on_tabs();
/// Returns the width of the buttons that draw_page_buttons() draws, pixels; 0: the tab has one page.
float page_buttons_width(Tab which);
/// Draws a button for each page of a tab with several pages.
void draw_page_buttons(WindowState& window, Tab which);

}  // namespace si
