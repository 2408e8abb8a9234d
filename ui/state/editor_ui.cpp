#include "ui/state/editor_ui.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/settings/overlays.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/state/frame_times.h"
#include "ui/state/panels.h"
#include "ui/state/playback.h"
#include "ui/state/quick_changes.h"
#include "ui/state/selection.h"
#include "ui/widgets/overlay_widget.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kPictures = 10;        ///< least height of the pictures that the tabs below leave, ems
constexpr float kTabs = 13;            ///< height of the tabs below, ems
constexpr float kHighTabs = 18;        ///< of those with a drawing, a plot or many numbers
constexpr float kAllTabs = 40;         ///< width in which all of them have room, ems
constexpr float kEveryday = 24.6f;     ///< height in which the settings of every day need no scrolling, ems
constexpr float kMapTexts = 6.2f;      ///< height of what stands above and below the map, ems
constexpr float kMapPlots = 6.5f;      ///< of its plots
constexpr float kBesideSettings = 40;  ///< width that settings wider than a third leave, ems
constexpr float kSplitter = 5;         ///< at scale 1, pixels
constexpr int kArrowsFast = 10;        ///< pixels, with Shift
constexpr int kF12 = 301;
constexpr int kF11 = 300;  ///< as the window feeds it (GLFW)

bool pressed(char key) {
    return ImGui::IsKeyPressed(int(key), false);
}
bool pressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
}

bool popup_is_open() {
    return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
}

/// The arrow keys move the probe by a pixel; what it sticks to is found anew.
void step_probe(EditorState& state, const EditorFrame& frame) {
    if (pressed(ImGuiKey_Tab)) state.probe_has_arrows = false;
    if (!state.probe_has_arrows || !state.probe_pixel || !frame.result) return;
    const int far = ImGui::GetIO().KeyShift ? kArrowsFast : 1;
    glm::ivec2 by(0);
    for (const auto& [key, way] : {std::pair{ImGuiKey_LeftArrow, glm::ivec2(-1, 0)},
                                   {ImGuiKey_RightArrow, glm::ivec2(1, 0)},
                                   {ImGuiKey_UpArrow, glm::ivec2(0, -1)},
                                   {ImGuiKey_DownArrow, glm::ivec2(0, 1)}})
        if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(key))) by += far * way;
    if (by == glm::ivec2(0)) return;
    const glm::ivec2 size(frame.result->colour.width, frame.result->colour.height);
    state.probe_pixel = glm::clamp(*state.probe_pixel + by, glm::ivec2(0), glm::max(size, 1) - 1);
}

/// Where the arrow keys move the probe they do not go from widget to widget.
void share_arrows(EditorState& state) {
    ImGuiIO& io = ImGui::GetIO();
    const bool mine = state.probe_has_arrows && state.probe_pixel && !popup_is_open();
    if (mine && (io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard)) {
        io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
        state.took_navigation = true;
    } else if (!mine && state.took_navigation) {
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
        state.took_navigation = false;
    }
}

/// PageUp and PageDown go to other presets, and scroll nothing and focus nothing, but in a menu.
void share_page_keys(EditorState& state) {
    int* const keys = ImGui::GetIO().KeyMap;
    if (keys[ImGuiKey_PageUp] >= 0) state.page_keys = {keys[ImGuiKey_PageUp], keys[ImGuiKey_PageDown]};
    const bool theirs = popup_is_open();
    keys[ImGuiKey_PageUp] = theirs ? state.page_keys[0] : -1;
    keys[ImGuiKey_PageDown] = theirs ? state.page_keys[1] : -1;
}

/// H hides what is chosen, with Shift all else; with Alt everything is there again.
void steer_hiding(EditorState& state, const EditorFrame& frame) {
    const ImGuiIO& io = ImGui::GetIO();
    const std::set<std::string> chosen = selected_objects(state);
    if (io.KeyAlt)
        show_all(state.settings);
    else if (chosen.empty() || !frame.scene)
        state.log.add(LogKind::Info, "Nothing is selected to hide: double-click an object");
    else if (io.KeyShift)
        isolate(state.settings, *frame.scene, chosen);
    else
        hide(state.settings, chosen);
}

/// Digits, alone or with one of the keys that are held, choose the overlay of the pane that the mouse was over last.
void choose_overlay(EditorState& state) {
    const ImGuiIO& io = ImGui::GetIO();
    const HeldKeys held{io.KeyShift, io.KeyAlt, io.KeyCtrl};
    // Held against another, the picture is one pane.
    const int pane = state.against.view == AgainstView::Off ? state.active_pane : 0;
    const SettingRef of = *find_setting(overlay_setting(pane));
    const int shown = std::get<int>(get_value(state.settings, of));
    for (int digit = 0; digit <= 9; ++digit) {
        if (!pressed(char('0' + digit))) continue;
        const int wanted = overlay_of_digit(digit, held);
        if (wanted > 0 || digit == 0) set_value(state.settings, of, wanted == shown ? 0 : wanted);
    }
}

/// A picture of this frame, which shows what is to be seen in it.
void take_shot(EditorState& state, EditorActions& actions, Shot of) {
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    const ScreenRect rect = of == Shot::Scene     ? state.scene_rect
                            : of == Shot::Map     ? state.map_rect
                            : of == Shot::Drawing ? state.drawing_rect
                                                  : ScreenRect{{0, 0}, {all.x, all.y}};
    if (rect.size.x >= 1 && rect.size.y >= 1)
        actions.shot = ShotWish{of, rect};
    else
        state.log.add(LogKind::Info, of == Shot::Map ? "The map is hidden (N): no screenshot of it"
                                     : of == Shot::Drawing
                                         ? "No drawing is shown: click a pixel, and open Probe in a wide window"
                                         : "The scene is hidden: no screenshot of it");
}

// Letters and digits are looked up by their ASCII code: the window feeds codes that equal it (GLFW's do).
void shortcuts(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool elsewhere = keys_are_taken(state);
    // Escape has closed a menu before anybody asks for it here.
    const bool popup = popup_is_open() || state.had_popup;
    steer_flicker(state, !elsewhere && !popup && !io.KeyCtrl);
    if (elsewhere) return;
    if (popup) {  // keys are for it
        if (pressed(ImGuiKey_Escape)) state.show_shortcuts = state.show_welcome = false;
        return;
    }
    Settings& s = state.settings;
    if (ImGui::IsKeyPressed(kF12, false))
        state.shot_next = io.KeyCtrl ? Shot::Window : io.KeyShift ? Shot::Map : Shot::Scene;
    if (io.KeyCtrl) {
        if (pressed('Z') && !io.KeyShift) undo(state);
        if (pressed('Y') || (pressed('Z') && io.KeyShift)) redo(state);
        if (pressed('S') && !io.KeyShift) actions.save_preset = state.preset_path;
        if (pressed('S') && io.KeyShift)
            ask_for_file(state.file_dialog, FileDialog::Job::SavePreset, state.preset_path, state.guide.about);
        if (pressed('R')) actions.load_preset = state.preset_path;
        if (pressed('O')) ask_for_file(state.file_dialog, FileDialog::Job::Open, state.preset_path);
        if (pressed('C') && io.KeyShift) actions.copy_command_line = true;
        if (pressed('Q')) actions.quit = true;
        choose_overlay(state);
        return;
    }
    choose_overlay(state);
    for (const int step : {-1, +1})
        if (const int key = state.page_keys[step > 0]; key >= 0 && ImGui::IsKeyPressed(key, false))
            actions.load_preset = neighbour_preset(state, frame, step);
    if (pressed('F')) frame_selection(state, frame);
    if (pressed('L')) toggle_light_camera(state);
    if (pressed(' ') && !io.NavVisible) toggle_play(state, frame);
    if (pressed('K')) toggle_frozen_camera(state, frame);
    if (pressed('B') && !state.flicker) state.against.view = AgainstView((int(state.against.view) + 1) % 4);
    if (pressed('P')) pin_settings(state);
    if (pressed('H')) steer_hiding(state, frame);
    if (pressed('G')) state.loupe = LoupeMode((int(state.loupe) + 1) % 3);
    step_probe(state, frame);
    if (pressed('X')) next_artefact(state, frame);
    if (pressed('C')) apply_fix(state, frame);
    if (pressed('U')) remove_bias(s);
    if (pressed('T')) next_light_type(s);
    if (pressed('[') || pressed(']')) scale_resolution(s, pressed(']'));
    if (pressed('Q')) point_quads(state, frame);
    for (const auto& [key, step] : {std::pair{',', -0.02f}, std::pair{'.', 0.02f}})
        if (state.against.view == AgainstView::Swipe && ImGui::IsKeyPressed(int(key)))
            state.against.at = std::clamp(state.against.at + step * (io.KeyShift ? 5 : 1), 0.0f, 1.0f);
    if (pressed('N')) state.layout.map_place = MapSpot((int(state.layout.map_place) + 1) % 4);
    if (pressed('M')) s.view.map = (s.view.map + 1) % 3;
    if (pressed(ImGuiKey_Home)) reset_camera(state, frame);
    if (ImGui::IsKeyPressed(kF11, false)) maximise(state, state.maximised ? *state.maximised : state.hovered_panel);
    if (pressed(ImGuiKey_Escape) && state.maximised) {
        state.maximised.reset();
    } else if (pressed(ImGuiKey_Escape)) {
        if (!state.probe_pixel) select_objects(state, {});
        state.probe_pixel.reset();
        state.show_shortcuts = false;
    }
}

struct Dragged {
    float by = 0;        ///< along its axis, pixels
    bool reset = false;  ///< a double click asks for the place at first
};

/// A bar to drag.
Dragged splitter(const char* id, bool vertical, ImVec2 size) {
    ImGui::InvisibleButton(id, size);
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (hot) ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    const float thin = hot ? 1.0f : 0.5f;
    const ImVec2 c(0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y));
    const ImU32 colour = hot ? theme::muted() : theme::line();
    if (vertical)
        ImGui::GetWindowDrawList()->AddRectFilled({c.x - thin, lo.y}, {c.x + thin, hi.y}, colour);
    else
        ImGui::GetWindowDrawList()->AddRectFilled({lo.x, c.y - thin}, {hi.x, c.y + thin}, colour);
    if (hot && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) return {.reset = true};
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) ImGui::SetTooltip("Drag; double-click: as at first");
    if (!ImGui::IsItemActive()) return {};
    return {.by = vertical ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y};
}

void tab(EditorState& state, BottomTab which, const char* label, const auto& draw) {
    const bool asked = state.open_tab == which;
    if (!ImGui::BeginTabItem(label, nullptr, asked ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None)) return;
    if (!state.open_tab && state.tab != which) state.fitted_tab = which;
    if (!state.open_tab || asked) state.tab = which;
    ImGui::BeginChild(label, {0, 0}, false);
    draw();
    ImGui::EndChild();
    ImGui::EndTabItem();
}

/// The legend of that overlay has numbers.
bool shows_artefacts(const Settings& settings) {
    return some_pane_shows(settings.view, &Overlay::names_causes);
}

/// On a tab, or in the row beside them; the arrows that scroll them are pressed fast, too, and lie without.
bool double_click_on_tabs() {
    const ImGuiTabBar* bar = ImGui::GetCurrentContext()->CurrentTabBar;
    return ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) &&
           ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&  // its tab is
           bar->BarRect.Contains(ImGui::GetIO().MousePos);
}

void bottom_tabs(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    // Tabs that have no room are scrolled to and listed, not squeezed to a letter.
    ImGuiTabBarFlags flags = ImGuiTabBarFlags_FittingPolicyScroll;
    if (ImGui::GetContentRegionAvail().x < ImGui::GetFontSize() * kAllTabs)
        flags |= ImGuiTabBarFlags_TabListPopupButton;
    if (!ImGui::BeginTabBar("bottom", flags)) return;
    const auto asked = state.open_tab;
    tab(state, BottomTab::Effects, "Effects", [&] { draw_effects(state, frame, actions); });
    tab(state, BottomTab::Probe, "Probe", [&] { draw_probe(state, frame, actions); });
    tab(state, BottomTab::Error, "Error", [&] { draw_error(state, frame, actions); });
    tab(state, BottomTab::Objects, "Objects", [&] { draw_objects(state, frame); });
    tab(state, BottomTab::Compare, "Compare", [&] { draw_compare(state, frame, actions); });
    tab(state, BottomTab::Frontier, "Frontier", [&] { draw_frontier(state, frame, actions); });
    tab(state, BottomTab::Advice, "Advice", [&] { draw_advice_panel(state, frame, actions); });
    tab(state, BottomTab::Lab, "Lab", [&] { draw_lab(state, frame, actions); });
    tab(state, BottomTab::Numbers, "Numbers", [&] { draw_health(state, frame, actions); });
    const int errors = state.log.unseen_errors();
    const std::string log = errors > 0 ? fmt::format("Log ({})###Log", errors) : std::string("Log###Log");
    if (errors > 0) ImGui::PushStyleColor(ImGuiCol_Text, theme::error());
    tab(state, BottomTab::Log, log.c_str(), [&] { draw_log(state, frame); });
    if (errors > 0) ImGui::PopStyleColor();
    if (asked == state.tab) state.open_tab.reset();
    actions.redraw |= state.open_tab.has_value();
    actions.want_timing = state.tab == BottomTab::Effects;
    actions.want_error = state.tab == BottomTab::Error;
    if (double_click_on_tabs()) maximise(state, Panel::Tabs);
    ImGui::EndTabBar();
}

void child(const char* id, ImVec2 size, const auto& draw) {
    ImGui::BeginChild(
        id, size, false,
        ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw();
    ImGui::EndChild();
}

/// Draws with the usual gaps inside, where there are none between the parts of the window.
auto spaced(const auto& draw) {
    return [draw] {
        const float em = ImGui::GetFontSize();
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(em * 0.53f, em * 0.33f));
        draw();
        ImGui::PopStyleVar();
    };
}

void panel(EditorState& state, Panel which, const char* id, ImVec2 size, const auto& draw) {
    child(id, size, spaced(draw));
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_RectOnly)) state.hovered_panel = which;
}

void scene_panel(EditorState& state, const EditorFrame& frame, EditorActions& actions, ImVec2 size) {
    panel(state, Panel::Scene, "scene", size, [&] { draw_viewport(state, frame, actions); });
}

void map_panel(EditorState& state, const EditorFrame& frame, EditorActions& actions, ImVec2 size) {
    panel(state, Panel::Map, "map", size, [&] { draw_map_viewer(state, frame, actions); });
}

void tabs_panel(EditorState& state, const EditorFrame& frame, EditorActions& actions, ImVec2 size) {
    panel(state, Panel::Tabs, "bottom", size, [&] { bottom_tabs(state, frame, actions); });
}

/// The panel that fills the window.
void one_panel(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    ImVec2 rest = ImGui::GetContentRegionAvail();
    rest.y -= status_bar_height();
    switch (*state.maximised) {
        case Panel::Scene:
            scene_panel(state, frame, actions, rest);
            break;
        case Panel::Map:
            map_panel(state, frame, actions, rest);
            break;
        case Panel::Tabs:
            tabs_panel(state, frame, actions, rest);
            break;
    }
    child("status", {0, status_bar_height()}, spaced([&] { draw_status_bar(state, frame); }));
}

/// The scene and, where it stands there, the map beside or in it.
void pictures_row(EditorState& state, const EditorFrame& frame, EditorActions& actions, ImVec2 size, float bar) {
    EditorLayout& layout = state.layout;
    const float em = ImGui::GetFontSize();
    if (layout.map_place == MapSpot::BesideScene) {
        const float map = std::clamp(size.x * layout.map_share, em * 8, std::max(em * 8, size.x - em * 12));
        scene_panel(state, frame, actions, {size.x - map - bar, size.y});
        ImGui::SameLine();
        if (const Dragged d = splitter("map splitter", true, {bar, size.y}); d.reset)
            layout.map_share = EditorLayout{}.map_share;
        else if (d.by != 0)
            layout.map_share = std::clamp((map - d.by) / size.x, 0.1f, 0.85f);
        ImGui::SameLine();
        map_panel(state, frame, actions, {map, size.y});
        return;
    }
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    scene_panel(state, frame, actions, size);
    if (layout.map_place != MapSpot::Inset) return;
    const float side = std::min(layout.map_inset * em, 0.6f * std::min(size.x, size.y));
    const ImVec2 after = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({corner.x + size.x - side - em, corner.y + size.y - side - em});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::panel());
    map_panel(state, frame, actions, {side, side});
    ImGui::PopStyleColor();
    ImGui::SetCursorScreenPos(after);
}

/// The settings and, where it stands there, the map above them.
void right_column(EditorState& state, const EditorFrame& frame, EditorActions& actions, ImVec2 size, float bar) {
    EditorLayout& layout = state.layout;
    const float em = ImGui::GetFontSize();
    ImGui::BeginGroup();
    if (layout.map_place == MapSpot::AboveSettings) {
        // Until somebody drags it, the map leaves the settings their room, and all that a square does not fill.
        const bool as_given = layout.map_height == EditorLayout{}.map_height;
        const float square = size.x + em * (layout.map_plots ? kMapTexts + kMapPlots : kMapTexts);
        const float wanted = as_given ? std::min(size.y * layout.map_height, square) : size.y * layout.map_height;
        const float map = std::clamp(wanted, em * 8, std::max(em * 8, size.y - em * (as_given ? kEveryday : 10)));
        map_panel(state, frame, actions, {size.x, map});
        if (const Dragged d = splitter("map splitter", false, {size.x, bar}); d.reset)
            layout.map_height = EditorLayout{}.map_height;
        else if (d.by != 0)
            layout.map_height = std::clamp((map + d.by) / size.y, 0.1f, 0.9f);
        size.y -= map + bar;
    }
    child("settings", size, spaced([&] { draw_settings(state, frame, actions); }));
    ImGui::EndGroup();
}

/// How much of that width the settings may have: half of it, but of a narrow window a third.
float most_settings(float width) {
    return std::clamp(width - kBesideSettings * ImGui::GetFontSize(), width / 3, width / 2);
}

/// What a tab needs, ems. Never less than others, so that a click on a pixel, which opens one, finds room for it.
float needed_height(BottomTab tab) {
    constexpr BottomTab kHigh[] = {BottomTab::Probe, BottomTab::Error, BottomTab::Frontier};
    return std::ranges::find(kHigh, tab) != std::end(kHigh) ? kHighTabs : kTabs;
}

void all_panels(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    const float em = ImGui::GetFontSize(), bar = kSplitter * em / 15;
    const float top = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y;
    child("top", {0, top}, spaced([&] { draw_top_bar(state, frame, actions); }));

    EditorLayout& layout = state.layout;
    const float status = status_bar_height();
    ImVec2 rest = ImGui::GetContentRegionAvail();
    rest.y -= status;
    const float settings =
        std::floor(std::clamp(layout.settings_width * em, em * 14, std::max(em * 14, most_settings(rest.x))));
    const float left = std::max(rest.x - settings - bar, em * 10);

    ImGui::BeginGroup();
    draw_strips(state, frame, actions, left);
    const float strips = std::max(0.0f, ImGui::GetCursorPosY() - top), time = time_bar_height(frame);
    // Where there is little room the tabs below give way to the pictures.
    const float most = std::max(em * 4, std::min(rest.y * 0.7f, rest.y - strips - bar - time - em * kPictures));
    const float wanted = layout.bottom_height > 0 ? layout.bottom_height : needed_height(state.fitted_tab);
    const float bottom = std::clamp(wanted * em, em * 4, most);
    const float pictures = std::max(rest.y - strips - bottom - bar - time, em * 6);
    pictures_row(state, frame, actions, {left, pictures}, bar);
    if (time > 0) child("time", {left, time}, spaced([&] { draw_time_bar(state, frame); }));
    if (const Dragged d = splitter("bottom splitter", false, {left, bar}); d.reset)
        layout.bottom_height = EditorLayout{}.bottom_height;
    else if (d.by != 0)
        layout.bottom_height = std::max((bottom - d.by) / em, 2.0f);
    tabs_panel(state, frame, actions, {left, bottom});
    ImGui::EndGroup();
    ImGui::SameLine();
    if (const Dragged d = splitter("settings splitter", true, {bar, rest.y}); d.reset)
        layout.settings_width = EditorLayout{}.settings_width;
    else if (d.by != 0)
        layout.settings_width = (settings - d.by) / em;
    ImGui::SameLine();
    right_column(state, frame, actions, {settings, rest.y}, bar);
    child("status", {0, status}, spaced([&] { draw_status_bar(state, frame); }));
}

}  // namespace

bool keys_are_taken(const EditorState& state) {
    const bool typing = ImGui::GetIO().WantTextInput || ImGui::GetCurrentContext()->WantTextInputNextFrame == 1;
    return typing || state.flight.on || state.handle_drag;
}

void maximise(EditorState& state, Panel panel) {
    if (state.maximised == panel)
        state.maximised.reset();
    else
        state.maximised = panel;
}

EditorActions draw_editor(EditorState& state, const EditorFrame& frame) {
    EditorActions actions;
    const std::optional<Shot> shot = std::exchange(state.shot_next, {});
    state.scene_rect = state.map_rect = state.drawing_rect = {};
    state.dragging = false;
    theme::use(state.layout.light_theme);
    use_driver(frame.driver);
    use_scene(frame.scene);
    use_result(frame.result);
    if (frame.result && frame.scene) keep_times(state.times, *frame.result, frame.scene->name, ImGui::GetTime());
    play_on(state, frame, double(ImGui::GetIO().DeltaTime));
    // What is clicked in this very frame, as where frames are slow, may be a field that the letters are for.
    const bool keys_wait = ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    if (!keys_wait) shortcuts(state, frame, actions);
    follow_fix(state, frame);
    const bool waits = follow_artefact_tour(state, frame);

    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(io.DisplaySize);
    // A smaller window than its least size, which some window managers make, is scrolled.
    const ImVec2 least(kLeastWidth / 15 * ImGui::GetFontSize(), kLeastHeight / 15 * ImGui::GetFontSize());
    const bool cramped = io.DisplaySize.x < least.x || io.DisplaySize.y < least.y;
    if (cramped)
        ImGui::SetNextWindowContentSize({std::max(io.DisplaySize.x, least.x), std::max(io.DisplaySize.y, least.y)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::Begin("editor", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse |
                     (cramped ? ImGuiWindowFlags_HorizontalScrollbar : ImGuiWindowFlags_NoScrollbar));
    ImGui::PopStyleVar();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    if (state.maximised)
        one_panel(state, frame, actions);
    else
        all_panels(state, frame, actions);
    ImGui::PopStyleVar();
    draw_welcome(state, frame, actions);
    draw_shortcuts(state);
    draw_file_dialog(state, frame, actions);
    draw_replace_dialog(state, actions);
    ImGui::End();

    if (keys_wait) {
        shortcuts(state, frame, actions);
        actions.redraw = true;
    }
    if (state.tab != BottomTab::Objects || (state.maximised && *state.maximised != Panel::Tabs))
        state.hovered_object.clear();  // no list that says it
    actions.want_error |= shows_artefacts(state.settings) || waits;
    share_arrows(state);
    share_page_keys(state);
    state.had_popup = popup_is_open();
    if (shot) take_shot(state, actions, *shot);
    actions.redraw |= state.shot_next.has_value();
    const bool turning_wheel = ImGui::GetTime() < state.wheel_until;
    const bool gesture = ImGui::IsAnyItemActive() || state.dragging || turning_wheel;
    state.history.set_place({state.scene_name, state.guide});
    state.history.observe(state.settings, gesture || state.between_steps);
    // Not for a click: what the window says of a cursor that is moved there and back would turn the camera.
    actions.hold_cursor =
        state.flight.on && (state.flew || ImGui::IsMouseDragging(ImGuiMouseButton_Right, kClickPixels));
    actions.redraw |= state.playback.playing || turning_wheel || state.flight.moving;
    actions.at_rest = !gesture && !actions.redraw && !ImGui::IsAnyMouseDown() && io.MouseWheel == 0 &&
                      io.MouseDelta.x == 0 && io.MouseDelta.y == 0;
    use_driver(nullptr);  // facts of this frame
    use_scene(nullptr);
    use_result(nullptr);
    return actions;
}

}  // namespace si
