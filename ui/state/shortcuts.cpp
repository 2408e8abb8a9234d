#include "ui/state/shortcuts.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/base/index_of.h"
#include "renderer/settings/overlays.h"
#include "ui/panels/lights_panel.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/scene_view/scene_marks.h"
#include "ui/state/panels.h"
#include "ui/state/playback.h"
#include "ui/state/quick_changes.h"
#include "ui/state/selection.h"
#include "ui/widgets/overlay_widget.h"

namespace si {
namespace {

constexpr int kFastArrowPixels = 10;  ///< step of the probe with Shift
constexpr float kSwipeStep = 0.02f;   ///< share of the picture's width
constexpr float kFastSwipe = 5;       ///< factor of that step with Shift

// Codes of keys without a character, as the window feeds them (GLFW).
constexpr int kF1 = 290;
constexpr int kF2 = 291;
constexpr int kF6 = 295;
constexpr int kF10 = 299;
constexpr int kF11 = 300;
constexpr int kF12 = 301;

constexpr Chord key(const char* name, int code) {
    return {.name = name, .first = code, .last = code};
}
constexpr Chord letter(const char* name) {
    return key(name, name[0]);
}
constexpr Chord mapped(const char* name, int first, int last = 0) {
    return {.name = name, .mapped = true, .first = first, .last = std::max(first, last)};
}
constexpr Chord with_shift(Chord chord, Modifier shift, Modifier alt = Modifier::Any) {
    chord.shift = shift;
    chord.alt = alt;
    return chord;
}
constexpr Chord with_ctrl(Chord chord, Modifier shift = Modifier::Any) {
    chord.ctrl = Modifier::Down;
    chord.shift = shift;
    return chord;
}
constexpr Chord with_any(Chord chord) {
    chord.ctrl = Modifier::Any;
    return chord;
}

void move_probe(const CommandContext& c) {
    if (!c.state.probe_pixel || !c.frame.result) return;
    const int step = ImGui::GetIO().KeyShift ? kFastArrowPixels : 1;
    const glm::ivec2 direction = c.key == ImGuiKey_LeftArrow    ? glm::ivec2(-1, 0)
                                 : c.key == ImGuiKey_RightArrow ? glm::ivec2(1, 0)
                                 : c.key == ImGuiKey_UpArrow    ? glm::ivec2(0, -1)
                                                                : glm::ivec2(0, 1);
    const glm::ivec2 size(c.frame.result->colour.width, c.frame.result->colour.height);
    c.state.probe_pixel =
        glm::clamp(*c.state.probe_pixel + step * direction, glm::ivec2(0), glm::max(size, glm::ivec2(1)) - 1);
}

/// Hides the selected objects, or all others; without a selection the log tells the user to select some.
void hide_selected(const CommandContext& c, bool others) {
    const std::set<std::string> selected = selected_objects(c.state);
    if (selected.empty() || !c.frame.scene)
        c.state.log.add(LogKind::Info, "Nothing is selected to hide: double-click an object");
    else if (others)
        isolate(c.state.settings, *c.frame.scene, selected);
    else
        hide(c.state.settings, selected);
}

/// Returns the overlay of the pane that the mouse was over last. A comparison shows one pane only.
int& active_overlay(EditorState& state) {
    const int pane = state.comparison.view == ComparisonView::Off ? state.active_pane : 0;
    return overlay_of_pane(state.settings.view, std::size_t(pane));
}

void toggle_overlay(const CommandContext& c) {
    const ImGuiIO& io = ImGui::GetIO();
    const int wanted = overlay_of_digit(c.key - '0', {io.KeyShift, io.KeyAlt, io.KeyCtrl});
    int& shown = active_overlay(c.state);
    if (wanted > 0) shown = wanted == shown ? 0 : wanted;
}

void move_swipe(EditorState& state, float step) {
    const float factor = ImGui::GetIO().KeyShift ? kFastSwipe : 1;
    state.comparison.at = std::clamp(state.comparison.at + step * factor, 0.0f, 1.0f);
}

/// Gives the keyboard to the panel that is `step` places after the one that had it last.
void focus_panel(EditorState& state, int step) {
    KeyboardState& keyboard = state.keyboard;
    keyboard.step = step;
    keyboard.wanted = part_after(keyboard.focused, step);
    keyboard.probe_has_arrows = false;
}

/// Opens the tab of a digit: 1 is the first tab of the inspector, 0 the last of the strip.
void open_tab_of_digit(const CommandContext& c) {
    WindowState& window = c.state.window;
    const int tab = c.key == '0' ? 9 : c.key - '1';
    window.open_page = window.pages[std::size_t(tab)];
    const Panel panel = is_in_inspector(Tab(tab)) ? Panel::Inspector : Panel::Strip;
    if (window.maximised && *window.maximised != panel) window.maximised.reset();
}

void toggle_strip(const CommandContext& c) {
    c.state.layout.strip_open = !c.state.layout.strip_open;
    c.state.window.maximised.reset();
}

/// Opens the panel Improve; while it is shown, chooses its next aim.
void next_improvement(const CommandContext& c) {
    ImproveMode& mode = c.state.improve.mode;
    if (c.state.shows(Page::Improve)) mode = next_of(mode, kImproveModes);
    open_improve(c.state, mode);
}

void forget_probe(const CommandContext& c) {
    if (!c.state.probe_pixel) select_objects(c.state, {});
    c.state.probe_pixel.reset();
    c.state.window.show_shortcuts = false;
}

void load_neighbour(const CommandContext& c, int step) {
    c.requests.load_preset = neighbour_preset(c.state, c.frame, step);
}

using C = const CommandContext&;

constexpr Shortcut row(Command command, Chord chord, const char* label, When when, void (*action)(C) = nullptr) {
    return {.command = command, .chord = chord, .when = when, .label = label, .action = action};
}
constexpr Shortcut row(Command command, Chord chord, const char* label, void (*action)(C)) {
    return row(command, chord, label, When::Ready, action);
}
/// Makes a row for the overview alone.
constexpr Shortcut gesture(const char* name, const char* label = "") {
    return {.chord = {.name = name}, .label = label};
}
/// Makes the row share its line of the overview with the row before.
constexpr Shortcut joined(Shortcut row) {
    row.joined = true;
    return row;
}
constexpr Shortcut repeating(Shortcut row) {
    row.repeats = true;
    return row;
}
constexpr Shortcut section(const char* heading, Shortcut row) {
    row.section = heading;
    return row;
}

constexpr Shortcut kShortcutTable[] = {
    section("Look", gesture("Drag", "turn the camera about its target")),
    joined(gesture("Ctrl+drag", "turn the light")),
    gesture("Middle drag", "move the camera sideways"),
    joined(gesture("Shift+drag")),
    gesture("Wheel", "closer, farther, towards the cursor"),
    gesture("Right button held", "fly with these keys; Shift: faster, wheel: speed"),
    row(Command::FlyForwards, with_any(letter("W")), "forwards", When::Flying),
    joined(row(Command::FlyBackwards, with_any(letter("S")), "backwards", When::Flying)),
    joined(row(Command::FlyLeft, with_any(letter("A")), "left", When::Flying)),
    joined(row(Command::FlyRight, with_any(letter("D")), "right", When::Flying)),
    joined(row(Command::FlyUp, with_any(letter("E")), "up", When::Flying)),
    joined(row(Command::FlyDown, with_any(letter("Q")), "down", When::Flying)),
    row(Command::FrameSelection, letter("F"), "frame what is selected or the scene",
        [](C c) { frame_selection(c.state, c.frame); }),
    joined(row(Command::ResetCamera, mapped("Home", ImGuiKey_Home), "the scene's own camera",
               [](C c) { reset_camera(c.state, c.frame); })),
    row(Command::ToggleLights, with_shift(letter("L"), Modifier::Up), "marks of the lights, or none",
        [](C c) { c.state.settings.view.frustum = !c.state.settings.view.frustum; }),
    joined(row(Command::ToggleLightCamera, with_shift(letter("L"), Modifier::Down), "through the light and back",
               [](C c) { toggle_light_camera(c.state); })),
    joined(row(Command::ToggleFrozenCamera, letter("K"), "freeze this view and fly with another",
               [](C c) { toggle_frozen_camera(c.state, c.frame); })),
    gesture("Click an end of the axes", "look along that axis"),
    row(Command::MaximisePanel, key("F11", kF11), "the panel under the mouse alone, and back",
        [](C c) {
            toggle_maximised(c.state,
                             c.state.window.maximised ? *c.state.window.maximised : c.state.window.hovered_panel);
        }),
    joined(gesture("double-click a title")),
    joined(row(Command::RestorePanels, mapped("Esc", ImGuiKey_Escape), "all panels", When::OnePanel,
               [](C c) { c.state.window.maximised.reset(); })),
    row(Command::OpenTab, with_ctrl({.name = "1 to 0", .first = '0', .last = '9'}), "tabs on the right, then below",
        open_tab_of_digit),
    joined(row(Command::ToggleStrip, letter("J"), "open or close those below", toggle_strip)),
    row(Command::NextPanel, with_shift(key("F6", kF6), Modifier::Up), "keyboard to the next panel",
        [](C c) { focus_panel(c.state, +1); }),
    joined(row(Command::PreviousPanel, with_shift(key("F6", kF6), Modifier::Down), "to the previous one",
               [](C c) { focus_panel(c.state, -1); })),
    joined(row(Command::FocusMenus, key("F10", kF10), "to the menus",
               [](C c) {
                   c.state.window.maximised.reset();
                   c.state.keyboard.wanted = WindowPart::Menus;
                   c.state.keyboard.probe_has_arrows = false;
               })),
    row(Command::NextMapPlace, letter("N"), "move the map to its next place",
        [](C c) { c.state.layout.map_place = MapSpot((int(c.state.layout.map_place) + 1) % 4); }),
    row(Command::NextMapView, letter("M"), "map: raw, linear, bands",
        [](C c) { c.state.settings.view.map = next_of(c.state.settings.view.map, 3); }),
    joined(gesture("wheel, drag, double-click", "zoom, move, fit")),

    section("Why", gesture("Click", "probe a pixel")),
    joined(row(Command::ForgetProbe, mapped("Esc", ImGuiKey_Escape), "forget it; again: select no object",
               When::AllPanels, forget_probe)),
    repeating(row(Command::MoveProbe, mapped("Arrows", ImGuiKey_LeftArrow, ImGuiKey_DownArrow),
                  "after a click: move the probe by a pixel, with Shift by 10", When::ProbeHasArrows, move_probe)),
    joined(row(Command::ReleaseArrows, mapped("Tab", ImGuiKey_Tab), "give the arrows to widgets", When::ProbeHasArrows,
               [](C c) { c.state.keyboard.probe_has_arrows = false; })),
    row(Command::NextLoupeMode, letter("G"), "loupe: on the probed pixel, under the mouse, off",
        [](C c) { c.state.loupe = LoupeMode((int(c.state.loupe) + 1) % 3); }),
    row(Command::NextWrongPixels, letter("X"), "to the next cluster of wrong pixels (cause: tab Error), and probe it",
        [](C c) { next_artefact(c.state, c.frame); }),
    row(Command::ApplyFix, letter("C"), "apply the verdict's fix", [](C c) { apply_fix(c.state, c.frame); }),
    joined(row(Command::RemoveBias, letter("U"), "all bias away", [](C c) { remove_bias(c.state.settings); })),
    joined(row(Command::NextImprovement, letter("I"), "Improve, its next aim", next_improvement)),
    row(Command::ToggleDepthQuads, letter("Q"), "stored-depth quads at the mouse or the probe; again: none",
        [](C c) { toggle_pointed_quads(c.state, c.frame); }),
    row(Command::ToggleOverlay, {.name = "1 to 9", .first = '1', .last = '9'},
        "overlays, more with Shift, Alt or both (their list has the keys); again: none", toggle_overlay),
    joined(row(Command::HideOverlay, letter("0"), "no overlay", [](C c) { active_overlay(c.state) = 0; })),

    section("Compare",
            row(Command::NextComparison, letter("B"), "with the reference or a preset: swipe, side by side, difference",
                [](C c) {
                    if (!c.state.flicker)
                        c.state.comparison.view = ComparisonView((int(c.state.comparison.view) + 1) % 4);
                })),
    repeating(row(Command::MoveSwipeLeft, letter(","), "swipe's line to the left", When::SwipeShown,
                  [](C c) { move_swipe(c.state, -kSwipeStep); })),
    joined(repeating(row(Command::MoveSwipeRight, letter("."), "to the right; Shift: farther", When::SwipeShown,
                         [](C c) { move_swipe(c.state, kSwipeStep); }))),
    row(Command::PinSettings, letter("P"), "pin the present settings as A, or take the pin off",
        [](C c) { pin_settings(c.state); }),
    joined(row(Command::ShowPinned, letter("A"), "held: A alone", [](C c) { begin_flicker(c.state); })),

    section("Lights", gesture("Drag a handle", "change the light, with Ctrl in round steps")),
    joined(row(Command::CancelHandleDrag, with_any(mapped("Esc", ImGuiKey_Escape)), "the light as before",
               When::HandleDragged, [](C c) { cancel_handle_drag(c.state); })),
    gesture("Click another light's mark", "show its map and handles"),
    row(Command::NextLightType, letter("T"), "the shown light: directional, spot, point",
        [](C c) { next_light_type(c.state.settings); }),
    joined(row(Command::RenameLight, with_any(key("F2", kF2)), "rename it", When::LightsListed,
               [](C c) { begin_light_rename(c.state.lights, c.state.settings, shown_light(c.state.settings)); })),
    row(Command::HalveResolution, letter("["), "half the resolution of the map",
        [](C c) { scale_resolution(c.state.settings, false); }),
    joined(row(Command::DoubleResolution, letter("]"), "twice", [](C c) { scale_resolution(c.state.settings, true); })),

    section("Objects", gesture("Double-click", "select an object")),
    gesture("Right click", "its menu: frame, hide, isolate, cast, receive, culling"),
    row(Command::HideSelected, with_shift(letter("H"), Modifier::Up, Modifier::Up), "hide the selected ones",
        [](C c) { hide_selected(c, false); }),
    joined(row(Command::IsolateSelected, with_shift(letter("H"), Modifier::Down, Modifier::Up), "hide all others",
               [](C c) { hide_selected(c, true); })),
    joined(row(Command::ShowAllObjects, with_shift(letter("H"), Modifier::Any, Modifier::Down), "show all",
               [](C c) { show_all(c.state.settings); })),
    gesture("Ctrl+click", "in the list: one more or less"),
    joined(gesture("Shift+click", "all between")),
    row(Command::TogglePlay, key("Space", ' '), "play or pause the animation", When::NoWidgetFocused,
        [](C c) { toggle_play(c.state, c.frame); }),

    section("Files and steps",
            row(Command::OpenFile, with_ctrl(letter("O")), "open a model or a preset",
                [](C c) { open_file_dialog(c.state.files.dialog, FileDialog::Job::Open, c.state.files.preset_path); })),
    joined(gesture("or drop a file")),
    row(Command::ReloadScene, with_ctrl(letter("R"), Modifier::Down), "read the scene's file again",
        [](C c) { c.requests.reload_scene = true; }),
    row(Command::SavePreset, with_ctrl(letter("S"), Modifier::Up), "save the preset",
        [](C c) { c.requests.save_preset = c.state.files.preset_path; }),
    joined(row(Command::SavePresetAs, with_ctrl(letter("S"), Modifier::Down), "save it as",
               [](C c) {
                   open_file_dialog(c.state.files.dialog, FileDialog::Job::SavePreset, c.state.files.preset_path,
                                    c.state.files.guide.about);
               })),
    row(Command::Export, with_ctrl(letter("E")), "export the frame: bundle, picture, map, engine code",
        [](C c) {
            open_file_dialog(c.state.files.dialog, FileDialog::Job::Export, c.state.files.preset_path,
                             scene_label(c.state.scene_name));
        }),
    row(Command::RevertPreset, with_ctrl(letter("R"), Modifier::Up), "back to the preset as it was saved",
        [](C c) { c.requests.load_preset = c.state.files.preset_path; }),
    row(Command::NextPreset, mapped("Page down", ImGuiKey_PageDown), "the next guided preset",
        [](C c) { load_neighbour(c, +1); }),
    joined(row(Command::PreviousPreset, mapped("Page up", ImGuiKey_PageUp), "the previous one",
               [](C c) { load_neighbour(c, -1); })),
    row(Command::Undo, with_ctrl(letter("Z"), Modifier::Up), "undo", [](C c) { undo(c.state); }),
    joined(row(Command::Redo, with_ctrl(letter("Y")), "redo", [](C c) { redo(c.state); })),
    joined(row(Command::Redo, with_ctrl(letter("Z"), Modifier::Down), "", [](C c) { redo(c.state); })),
    row(Command::CopyCommandLine, with_ctrl(letter("C"), Modifier::Down), "copy the command line",
        [](C c) { c.requests.copy_command_line = true; }),
    row(Command::SceneScreenshot, with_shift(key("F12", kF12), Modifier::Up),
        "screenshot of the scene, as PNG and in the clipboard", [](C c) { c.state.shots.next = Shot::Scene; }),
    joined(row(Command::MapScreenshot, with_shift(key("F12", kF12), Modifier::Down), "of the map",
               [](C c) { c.state.shots.next = Shot::Map; })),
    joined(row(Command::WindowScreenshot, with_ctrl(key("F12", kF12)), "of the window",
               [](C c) { c.state.shots.next = Shot::Window; })),
    row(Command::ToggleOverview, with_any(key("F1", kF1)), "this overview", When::Always,
        [](C c) { c.state.window.show_shortcuts = !c.state.window.show_shortcuts; }),
    joined(row(Command::CloseOverview, with_any(mapped("Esc", ImGuiKey_Escape)), "close it", When::PopupOpen,
               [](C c) { c.state.window.show_shortcuts = c.state.window.show_welcome = false; })),
    row(Command::Quit, with_ctrl(letter("Q")), "quit", [](C c) { c.requests.quit = true; }),

    section("Settings", row(Command::SearchSettings, with_ctrl(letter("F")), "search the settings",
                            [](C c) {
                                c.state.window.maximised.reset();
                                c.state.settings_panel.focus_search = true;
                                c.state.window.open_page = Page::Settings;
                                c.state.keyboard.focused = WindowPart::Inspector;
                            })),
    gesture("Ctrl+click on a slider", "type a value"),
    gesture("Right-click", "reset a setting, or copy it as --set"),
    gesture("Arrows, Space, Enter", "from widget to widget, press, edit"),
    gesture("Double-click a splitter", "as wide as at first"),
};

bool popup_open() {
    return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
}

/// Returns the present situation: Ready, PopupOpen, Flying or HandleDragged; none while a text is typed.
std::optional<When> present_mode(const EditorState& state) {
    if (text_is_typed()) return {};
    if (state.viewport.flight.on) return When::Flying;
    if (state.viewport.handle_drag) return When::HandleDragged;
    // ImGui closes a menu on Escape earlier in the same frame, so that the last frame's state counts.
    if (popup_open() || state.window.had_popup) return When::PopupOpen;
    return When::Ready;
}

/// Returns the wider situation that contains this one.
When mode_of(When when) {
    return when == When::Always || when >= When::PopupOpen ? when : When::Ready;
}

bool holds(When when, std::optional<When> mode, const EditorState& state) {
    if (when == When::Always) return true;
    if (mode != mode_of(when)) return false;
    switch (when) {
        case When::OnePanel:
            return state.window.maximised.has_value();
        case When::AllPanels:
            return !state.window.maximised;
        case When::ProbeHasArrows:
            return state.keyboard.probe_has_arrows;
        case When::NoWidgetFocused:
            return !ImGui::GetIO().NavVisible;
        case When::SwipeShown:
            return state.comparison.view == ComparisonView::Swipe;
        case When::LightsListed:
            return state.lights.listed;
        default:
            return true;
    }
}

bool matches(Modifier wanted, bool down) {
    return wanted == Modifier::Any || (wanted == Modifier::Down) == down;
}

/// Returns the window's code (GLFW) of an ImGui key; -1: unknown.
int window_code(const Chord& chord, int key, const EditorState& state) {
    if (!chord.mapped) return key;
    // ImGui gets no Page keys while they switch presets.
    if (key == ImGuiKey_PageUp) return state.keyboard.page_keys[0];
    if (key == ImGuiKey_PageDown) return state.keyboard.page_keys[1];
    return ImGui::GetKeyIndex(key);
}

const Shortcut& row_of(Command command) {
    return *std::ranges::find(kShortcutTable, command, &Shortcut::command);
}

}  // namespace

bool can_coincide(When a, When b) {
    if (a == When::Always || b == When::Always) return true;
    const bool one = a == When::OnePanel || b == When::OnePanel;
    const bool all = a == When::AllPanels || b == When::AllPanels;
    return mode_of(a) == mode_of(b) && !(one && all);
}

std::span<const Shortcut> shortcuts() {
    return kShortcutTable;
}

std::string chord_text(const Chord& chord) {
    std::string text;
    if (chord.ctrl == Modifier::Down) text += "Ctrl+";
    if (chord.shift == Modifier::Down) text += "Shift+";
    if (chord.alt == Modifier::Down) text += "Alt+";
    return text + chord.name;
}

const char* key_text(Command command) {
    static const auto kTexts = [] {
        std::map<Command, std::string> texts;
        for (const Shortcut& row : kShortcutTable) texts.try_emplace(row.command, chord_text(row.chord));
        return texts;
    }();
    return kTexts.at(command).c_str();
}

std::string with_key(std::string_view tooltip, Command command) {
    return fmt::format("{} ({})", tooltip, key_text(command));
}

bool is_held(Command command) {
    const Chord& chord = row_of(command).chord;
    return ImGui::IsKeyDown(chord.mapped ? ImGui::GetKeyIndex(chord.first) : chord.first);
}

void run_command(Command command, EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    row_of(command).action({state, frame, requests});
}

void dispatch_shortcuts(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    if (state.flicker && !is_held(Command::ShowPinned)) end_flicker(state);
    const ImGuiIO& io = ImGui::GetIO();
    const std::optional<When> mode = present_mode(state);
    // An action may change the situation, so that all keys are read before the first action.
    std::vector<std::pair<const Shortcut*, int>> pressed;
    for (const Shortcut& row : kShortcutTable) {
        const Chord& chord = row.chord;
        if (!row.action || !holds(row.when, mode, state)) continue;
        if (!matches(chord.ctrl, io.KeyCtrl) || !matches(chord.shift, io.KeyShift) || !matches(chord.alt, io.KeyAlt))
            continue;
        for (int k = chord.first; k <= chord.last; ++k) {
            const int code = window_code(chord, k, state);
            if (code >= 0 && ImGui::IsKeyPressed(code, row.repeats)) pressed.emplace_back(&row, k);
        }
    }
    for (const auto& [row, k] : pressed) row->action({state, frame, requests, k});
}

void assign_arrow_keys(EditorState& state) {
    ImGuiIO& io = ImGui::GetIO();
    const bool mine = state.keyboard.probe_has_arrows && state.probe_pixel && !popup_open();
    if (mine && (io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard)) {
        io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
        state.keyboard.took_navigation = true;
    } else if (!mine && state.keyboard.took_navigation) {
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
        state.keyboard.took_navigation = false;
    }
}

void assign_page_keys(EditorState& state) {
    int* const keys = ImGui::GetIO().KeyMap;
    if (keys[ImGuiKey_PageUp] >= 0) state.keyboard.page_keys = {keys[ImGuiKey_PageUp], keys[ImGuiKey_PageDown]};
    const bool theirs = popup_open();
    keys[ImGuiKey_PageUp] = theirs ? state.keyboard.page_keys[0] : -1;
    keys[ImGuiKey_PageDown] = theirs ? state.keyboard.page_keys[1] : -1;
}

}  // namespace si
