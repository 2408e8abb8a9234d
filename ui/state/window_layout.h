// Arrangement of the editor's window: panels, splitters, tabs, popups; its keys and screenshots.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "renderer/base/index_of.h"

namespace si {

/// Place of the map viewer in the window.
enum class MapSpot { AboveSettings, NextToScene, Inset, Hidden };

/// Part of the editor that can fill the whole window.
enum class Panel { Scene, Map, Strip, Inspector };

/// Tab of the inspector on the right (the first five), or of the strip below the pictures. Ctrl+1 opens the first,
/// Ctrl+0 the tenth.
enum class Tab { Settings, Objects, Lights, Pixel, Improve, Error, Cost, Compare, Lab, Log };
inline constexpr int kTabs = index_of(Tab::Log) + 1;

/// Content of a tab of the editor. A tab with more than one page has a button for each.
enum class Page {
    Settings,
    Objects,
    Lights,
    Pixel,
    Improve,
    Error,
    Frontier,
    Effects,
    LightPath,
    Compare,
    Imported,
    Lab,
    Numbers,
    Log
};
inline constexpr int kPages = index_of(Page::Log) + 1;

/// Row of the table of the editor's pages: tab, button label and name for the command-line option --tab.
struct PageRow {
    Page page;
    Tab tab;
    const char* label;           ///< text of the page's button in a tab with several pages
    const char* key;             ///< name of the option --tab
    const char* other_key = "";  ///< another name of the option; empty: none
};
/// Table of all pages, indexed by Page. At first, a tab shows its first page.
inline constexpr PageRow kPageTable[kPages] = {{Page::Settings, Tab::Settings, "Settings", "settings"},
                                               {Page::Objects, Tab::Objects, "Objects", "objects"},
                                               {Page::Lights, Tab::Lights, "Lights", "lights"},
                                               {Page::Pixel, Tab::Pixel, "Pixel", "pixel", "probe"},
                                               {Page::Improve, Tab::Improve, "Improve", "improve"},
                                               {Page::Error, Tab::Error, "Error", "error"},
                                               {Page::Frontier, Tab::Cost, "Frontier", "frontier", "cost"},
                                               {Page::Effects, Tab::Cost, "Effects", "effects"},
                                               {Page::LightPath, Tab::Cost, "Light path", "light-path"},
                                               {Page::Compare, Tab::Compare, "Settings diff", "compare"},
                                               {Page::Imported, Tab::Compare, "Imported map", "imported"},
                                               {Page::Lab, Tab::Lab, "Precision, shimmer", "lab"},
                                               {Page::Numbers, Tab::Lab, "Numbers", "numbers"},
                                               {Page::Log, Tab::Log, "Log", "log"}};
/// Labels of the tabs, indexed by Tab.
inline constexpr const char* kTabLabels[kTabs] = {"Settings", "Objects", "Lights",  "Pixel", "Improve",
                                                  "Error",    "Cost",    "Compare", "Lab",   "Log"};

/// Returns the tab that contains a page.
constexpr Tab tab_of(Page page) {
    return kPageTable[index_of(page)].tab;
}
/// Returns true for a tab of the inspector, false for one of the strip below the pictures.
constexpr bool is_in_inspector(Tab tab) {
    return tab <= Tab::Improve;
}
/// Returns the first page of each tab, indexed by Tab.
constexpr std::array<Page, kTabs> first_pages() {
    std::array<Page, kTabs> pages{};
    for (int i = kPages - 1; i >= 0; --i) pages[std::size_t(index_of(kPageTable[i].tab))] = kPageTable[i].page;
    return pages;
}

/// Places of the window's splitters, and the theme; kept between runs in the workspace file. Sizes are in ems (heights
/// of the font), so that they survive a change of scale.
struct EditorLayout {
    float settings_width = 24;  ///< width of the inspector
    float bottom_height = 15;   ///< height of the open strip below, whichever tab is shown
    bool strip_open = false;    ///< the strip below shows a page; else only its tabs
    MapSpot map_place = MapSpot::AboveSettings;
    float map_height = 0.5f;      ///< share of the right column, for AboveSettings
    float map_share = 0.40f;      ///< share of the width left of the inspector, for NextToScene
    float map_inset = 20;         ///< width and height, for Inset
    bool map_plots = true;        ///< histogram and depth curve are drawn under the map
    bool light_theme = false;     ///< else the dark one
    bool desktop_dialogs = true;  ///< use the desktop's file dialog if there is one
    bool operator==(const EditorLayout&) const = default;
};

/// Open panels, tabs and popups of the editor's window. Not kept between runs.
struct WindowState {
    std::optional<Panel> maximised;                 ///< panel that fills the window; none: all are shown
    Panel hovered_panel = Panel::Scene;             ///< panel that the mouse was over last
    std::optional<Page> open_page;                  ///< page to bring to the front in the next frame
    std::array<Page, kTabs> pages = first_pages();  ///< page of each tab that was shown last, by Tab
    Tab strip_tab = Tab::Error;                     ///< tab of the strip that was shown last
    int shown_message = 0;                          ///< Log::added() of the message in the status bar
    double message_since = 0;                       ///< time at which that message came, seconds of ImGui's clock
    bool show_welcome = false;
    bool show_shortcuts = false;  ///< the overview of mouse and keyboard
    bool had_popup = false;       ///< a menu or dialog was open at the end of the last frame
};

/// Part of the window that can have the keyboard focus, in the order in which F6 visits the parts.
enum class WindowPart { Menus, Scene, Map, Time, Strip, Inspector, Status };
inline constexpr int kWindowParts = index_of(WindowPart::Status) + 1;

/// Returns the part of the window that gets the keyboard focus after `part`, cyclically.
/// @param step 1: the next part; -1: the previous one
constexpr WindowPart part_after(WindowPart part, int step) {
    return static_cast<WindowPart>((index_of(part) + step + kWindowParts) % kWindowParts);
}

/// State of the keyboard: the part of the window that has the focus, and the use of arrow and page keys, which ImGui
/// also uses for navigation.
struct KeyboardState {
    WindowPart focused = WindowPart::Status;  ///< part that was given the keyboard last
    std::optional<WindowPart> wanted;         ///< part that gets the keyboard as soon as it is drawn
    int step = 1;                             ///< direction in which a part that is not shown is passed over: 1 or -1
    bool probe_has_arrows = false;            ///< the arrow keys move the probe, not the focus
    bool took_navigation = false;             ///< ImGui's keyboard navigation is off for that reason
    std::array<int, 2> page_keys = {-1, -1};  ///< window codes of Page up and Page down; -1: not known yet
};

/// Part of the editor that a screenshot shows. Drawing: the cross-section of the probed pixel's shadow test along the
/// light's ray.
enum class Shot { Scene, Map, Window, Drawing };

/// Rectangle of the screen in ImGui's units, y down. Size 0: the part of the window that it describes was not drawn.
struct ScreenRect {
    glm::vec2 lo{0};
    glm::vec2 size{0};
};

/// Request for a screenshot of this frame of the editor.
struct ShotRequest {
    Shot of = Shot::Window;
    ScreenRect rect;  ///< part of the window to cut out
};

/// Screenshot to take in the next frame, and the places of the pictures in the window, which a screenshot can cut out.
struct ShotState {
    std::optional<Shot> next;  ///< taken in the next frame, once the menu that requested it is closed
    ScreenRect scene_rect;     ///< scene picture in the last frame
    ScreenRect map_rect;       ///< map in the last frame
    ScreenRect drawing_rect;   ///< cross-section in the last frame
};

}  // namespace si
