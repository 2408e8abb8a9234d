#include "ui/state/shortcuts.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/base/index_of.h"
#include "renderer/settings/overlays.h"
#include "ui/panels/lights_panel.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/scene_view/light_gizmo.h"
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
constexpr int kF11 = 300;
constexpr int kF12 = 301;

constexpr Chord key(const char* name, int code) {
    return {.name = name, .first = code, .last = code};
}
constexpr Chord letter(const char* name) {
    return key(name, name[0]);
}
constexpr Chord mapped(const char* name, int first, int last) {
    return {.name = name, .mapped = true, .first = first, .last = last};
}
constexpr Chord mapped(const char* name, int code) {
    return mapped(name, code, code);
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
constexpr Chord gesture(const char* name) {
    return {.name = name};
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

/// Returns the selected objects; without a selection the log tells the user to select some.
std::set<std::string> objects_to_hide(const CommandContext& c) {
    std::set<std::string> selected = selected_objects(c.state);
    if (selected.empty() || !c.frame.scene) {
        c.state.log.add(LogKind::Info, "Nothing is selected to hide: double-click an object");
        return {};
    }
    return selected;
}

void hide_selected(const CommandContext& c) {
    if (const auto selected = objects_to_hide(c); !selected.empty()) hide(c.state.settings, selected);
}

void isolate_selected(const CommandContext& c) {
    if (const auto selected = objects_to_hide(c); !selected.empty())
        isolate(c.state.settings, *c.frame.scene, selected);
}

/// Returns the overlay setting of the pane that the mouse was over last. A comparison shows one pane only.
SettingRef active_overlay(const EditorState& state) {
    const int pane = state.comparison.view == ComparisonView::Off ? state.active_pane : 0;
    return *find_setting(overlay_setting(pane));
}

void toggle_overlay(const CommandContext& c) {
    const ImGuiIO& io = ImGui::GetIO();
    const int wanted = overlay_of_digit(c.key - '0', {io.KeyShift, io.KeyAlt, io.KeyCtrl});
    const SettingRef setting = active_overlay(c.state);
    const int shown = std::get<int>(get_value(c.state.settings, setting));
    if (wanted > 0) set_value(c.state.settings, setting, wanted == shown ? 0 : wanted);
}

void move_swipe(EditorState& state, float step) {
    const float factor = ImGui::GetIO().KeyShift ? kFastSwipe : 1;
    state.comparison.at = std::clamp(state.comparison.at + step * factor, 0.0f, 1.0f);
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

constexpr Shortcut kShortcutTable[] = {
    {.chord = gesture("Drag"), .label = "turn the camera about its target", .section = "Look"},
    {.chord = gesture("Ctrl+drag"), .label = "turn the light", .joined = true},
    {.chord = gesture("Middle drag"), .label = "move the camera sideways"},
    {.chord = gesture("Shift+drag"), .joined = true},
    {.chord = gesture("Wheel"), .label = "closer, farther, towards the cursor"},
    {.chord = gesture("Right button held"), .label = "fly with these keys; Shift: faster, wheel: speed"},
    {.command = Command::FlyForwards, .chord = with_any(letter("W")), .when = When::Flying, .label = "forwards"},
    {.command = Command::FlyBackwards,
     .chord = with_any(letter("S")),
     .when = When::Flying,
     .label = "backwards",
     .joined = true},
    {.command = Command::FlyLeft,
     .chord = with_any(letter("A")),
     .when = When::Flying,
     .label = "left",
     .joined = true},
    {.command = Command::FlyRight,
     .chord = with_any(letter("D")),
     .when = When::Flying,
     .label = "right",
     .joined = true},
    {.command = Command::FlyUp, .chord = with_any(letter("E")), .when = When::Flying, .label = "up", .joined = true},
    {.command = Command::FlyDown,
     .chord = with_any(letter("Q")),
     .when = When::Flying,
     .label = "down",
     .joined = true},
    {.command = Command::FrameSelection,
     .chord = letter("F"),
     .label = "frame what is selected or the scene",
     .action = [](C c) { frame_selection(c.state, c.frame); }},
    {.command = Command::ResetCamera,
     .chord = mapped("Home", ImGuiKey_Home),
     .label = "the scene's own camera",
     .action = [](C c) { reset_camera(c.state, c.frame); },
     .joined = true},
    {.command = Command::ToggleLightCamera,
     .chord = letter("L"),
     .label = "through the light and back",
     .action = [](C c) { toggle_light_camera(c.state); }},
    {.command = Command::ToggleFrozenCamera,
     .chord = letter("K"),
     .label = "freeze this view and fly with another",
     .action = [](C c) { toggle_frozen_camera(c.state, c.frame); },
     .joined = true},
    {.chord = gesture("Click an end of the axes"), .label = "look along that axis"},
    {.command = Command::MaximisePanel,
     .chord = key("F11", kF11),
     .label = "the panel under the mouse alone, and back",
     .action =
         [](C c) {
             toggle_maximised(c.state,
                              c.state.window.maximised ? *c.state.window.maximised : c.state.window.hovered_panel);
         }},
    {.chord = gesture("double-click a title"), .joined = true},
    {.command = Command::RestorePanels,
     .chord = mapped("Esc", ImGuiKey_Escape),
     .when = When::OnePanel,
     .label = "all panels",
     .action = [](C c) { c.state.window.maximised.reset(); },
     .joined = true},
    {.command = Command::NextMapPlace,
     .chord = letter("N"),
     .label = "move the map to its next place",
     .action = [](C c) { c.state.layout.map_place = MapSpot((int(c.state.layout.map_place) + 1) % 4); }},
    {.command = Command::NextMapView,
     .chord = letter("M"),
     .label = "map: raw, linear, bands",
     .action = [](C c) { c.state.settings.view.map = next_of(c.state.settings.view.map, 3); }},
    {.chord = gesture("wheel, drag, double-click"), .label = "zoom, move, fit", .joined = true},

    {.chord = gesture("Click"), .label = "probe a pixel", .section = "Why"},
    {.command = Command::ForgetProbe,
     .chord = mapped("Esc", ImGuiKey_Escape),
     .when = When::AllPanels,
     .label = "forget it; again: select no object",
     .action = forget_probe,
     .joined = true},
    {.command = Command::MoveProbe,
     .chord = mapped("Arrows", ImGuiKey_LeftArrow, ImGuiKey_DownArrow),
     .when = When::ProbeHasArrows,
     .label = "after a click: move the probe by a pixel, with Shift by 10",
     .action = move_probe,
     .repeats = true},
    {.command = Command::ReleaseArrows,
     .chord = mapped("Tab", ImGuiKey_Tab),
     .when = When::ProbeHasArrows,
     .label = "give the arrows to widgets",
     .action = [](C c) { c.state.keyboard.probe_has_arrows = false; },
     .joined = true},
    {.command = Command::NextLoupeMode,
     .chord = letter("G"),
     .label = "loupe: on the probed pixel, under the mouse, off",
     .action = [](C c) { c.state.loupe = LoupeMode((int(c.state.loupe) + 1) % 3); }},
    {.command = Command::NextWrongPixels,
     .chord = letter("X"),
     .label = "to the next cluster of wrong pixels (cause: tab Error), and probe it",
     .action = [](C c) { next_artefact(c.state, c.frame); }},
    {.command = Command::ApplyFix,
     .chord = letter("C"),
     .label = "apply the verdict's fix",
     .action = [](C c) { apply_fix(c.state, c.frame); }},
    {.command = Command::RemoveBias,
     .chord = letter("U"),
     .label = "all bias away",
     .action = [](C c) { remove_bias(c.state.settings); },
     .joined = true},
    {.command = Command::ToggleDepthQuads,
     .chord = letter("Q"),
     .label = "stored-depth quads at the mouse or the probe; again: none",
     .action = [](C c) { toggle_pointed_quads(c.state, c.frame); }},
    {.command = Command::ToggleOverlay,
     .chord = {.name = "1 to 9", .first = '1', .last = '9', .ctrl = Modifier::Any},
     .label = "overlays, more with Shift, Alt or Ctrl (their list has the keys); again: none",
     .action = toggle_overlay},
    {.command = Command::HideOverlay,
     .chord = with_any(letter("0")),
     .label = "no overlay",
     .action = [](C c) { set_value(c.state.settings, active_overlay(c.state), 0); },
     .joined = true},

    {.command = Command::NextComparison,
     .chord = letter("B"),
     .label = "with the reference or a preset: swipe, side by side, difference",
     .action =
         [](C c) {
             if (!c.state.flicker) c.state.comparison.view = ComparisonView((int(c.state.comparison.view) + 1) % 4);
         },
     .section = "Compare"},
    {.command = Command::MoveSwipeLeft,
     .chord = letter(","),
     .when = When::SwipeShown,
     .label = "swipe's line to the left",
     .action = [](C c) { move_swipe(c.state, -kSwipeStep); },
     .repeats = true},
    {.command = Command::MoveSwipeRight,
     .chord = letter("."),
     .when = When::SwipeShown,
     .label = "to the right; Shift: farther",
     .action = [](C c) { move_swipe(c.state, kSwipeStep); },
     .repeats = true,
     .joined = true},
    {.command = Command::PinSettings,
     .chord = letter("P"),
     .label = "pin the present settings as A, or take the pin off",
     .action = [](C c) { pin_settings(c.state); }},
    {.command = Command::ShowPinned,
     .chord = letter("A"),
     .label = "held: A alone",
     .action = [](C c) { begin_flicker(c.state); },
     .joined = true},

    {.chord = gesture("Drag a handle"), .label = "change the light, with Ctrl in round steps", .section = "Lights"},
    {.command = Command::CancelHandleDrag,
     .chord = with_any(mapped("Esc", ImGuiKey_Escape)),
     .when = When::HandleDragged,
     .label = "the light as before",
     .action = [](C c) { cancel_handle_drag(c.state); },
     .joined = true},
    {.chord = gesture("Click another light's mark"), .label = "show its map and handles"},
    {.command = Command::NextLightType,
     .chord = letter("T"),
     .label = "the shown light: directional, spot, point",
     .action = [](C c) { next_light_type(c.state.settings); }},
    {.command = Command::RenameLight,
     .chord = with_any(key("F2", kF2)),
     .when = When::LightsListed,
     .label = "rename it",
     .action = [](C c) { begin_light_rename(c.state, shown_light(c.state.settings)); },
     .joined = true},
    {.command = Command::HalveResolution,
     .chord = letter("["),
     .label = "half the resolution of the map",
     .action = [](C c) { scale_resolution(c.state.settings, false); }},
    {.command = Command::DoubleResolution,
     .chord = letter("]"),
     .label = "twice",
     .action = [](C c) { scale_resolution(c.state.settings, true); },
     .joined = true},

    {.chord = gesture("Double-click"), .label = "select an object", .section = "Objects"},
    {.chord = gesture("Right click"), .label = "its menu: frame, hide, isolate, cast, receive, culling"},
    {.command = Command::HideSelected,
     .chord = with_shift(letter("H"), Modifier::Up, Modifier::Up),
     .label = "hide the selected ones",
     .action = hide_selected},
    {.command = Command::IsolateSelected,
     .chord = with_shift(letter("H"), Modifier::Down, Modifier::Up),
     .label = "hide all others",
     .action = isolate_selected,
     .joined = true},
    {.command = Command::ShowAllObjects,
     .chord = with_shift(letter("H"), Modifier::Any, Modifier::Down),
     .label = "show all",
     .action = [](C c) { show_all(c.state.settings); },
     .joined = true},
    {.chord = gesture("Ctrl+click"), .label = "in the list: one more or less"},
    {.chord = gesture("Shift+click"), .label = "all between", .joined = true},
    {.command = Command::TogglePlay,
     .chord = key("Space", ' '),
     .when = When::NoWidgetFocused,
     .label = "play or pause the animation",
     .action = [](C c) { toggle_play(c.state, c.frame); }},

    {.command = Command::OpenFile,
     .chord = with_ctrl(letter("O")),
     .label = "open a .gltf or .glb scene, or a preset",
     .action = [](C c) { open_file_dialog(c.state.files.dialog, FileDialog::Job::Open, c.state.files.preset_path); },
     .section = "Files and steps"},
    {.chord = gesture("or drop a file"), .joined = true},
    {.command = Command::SavePreset,
     .chord = with_ctrl(letter("S"), Modifier::Up),
     .label = "save the preset",
     .action = [](C c) { c.requests.save_preset = c.state.files.preset_path; }},
    {.command = Command::SavePresetAs,
     .chord = with_ctrl(letter("S"), Modifier::Down),
     .label = "save it as",
     .action =
         [](C c) {
             open_file_dialog(c.state.files.dialog, FileDialog::Job::SavePreset, c.state.files.preset_path,
                              c.state.files.guide.about);
         },
     .joined = true},
    {.command = Command::RevertPreset,
     .chord = with_ctrl(letter("R")),
     .label = "back to the preset as it was saved",
     .action = [](C c) { c.requests.load_preset = c.state.files.preset_path; }},
    {.command = Command::NextPreset,
     .chord = mapped("Page down", ImGuiKey_PageDown),
     .label = "the next guided preset",
     .action = [](C c) { load_neighbour(c, +1); }},
    {.command = Command::PreviousPreset,
     .chord = mapped("Page up", ImGuiKey_PageUp),
     .label = "the previous one",
     .action = [](C c) { load_neighbour(c, -1); },
     .joined = true},
    {.command = Command::Undo,
     .chord = with_ctrl(letter("Z"), Modifier::Up),
     .label = "undo",
     .action = [](C c) { undo(c.state); }},
    {.command = Command::Redo,
     .chord = with_ctrl(letter("Y")),
     .label = "redo",
     .action = [](C c) { redo(c.state); },
     .joined = true},
    {.command = Command::Redo,
     .chord = with_ctrl(letter("Z"), Modifier::Down),
     .action = [](C c) { redo(c.state); },
     .joined = true},
    {.command = Command::CopyCommandLine,
     .chord = with_ctrl(letter("C"), Modifier::Down),
     .label = "copy the command line",
     .action = [](C c) { c.requests.copy_command_line = true; }},
    {.command = Command::SceneScreenshot,
     .chord = with_shift(key("F12", kF12), Modifier::Up),
     .label = "screenshot of the scene, as PNG and in the clipboard",
     .action = [](C c) { c.state.shots.next = Shot::Scene; }},
    {.command = Command::MapScreenshot,
     .chord = with_shift(key("F12", kF12), Modifier::Down),
     .label = "of the map",
     .action = [](C c) { c.state.shots.next = Shot::Map; },
     .joined = true},
    {.command = Command::WindowScreenshot,
     .chord = with_ctrl(key("F12", kF12)),
     .label = "of the window",
     .action = [](C c) { c.state.shots.next = Shot::Window; },
     .joined = true},
    {.command = Command::ToggleOverview,
     .chord = with_any(key("F1", kF1)),
     .when = When::Always,
     .label = "this overview",
     .action = [](C c) { c.state.window.show_shortcuts = !c.state.window.show_shortcuts; }},
    {.command = Command::CloseOverview,
     .chord = with_any(mapped("Esc", ImGuiKey_Escape)),
     .when = When::PopupOpen,
     .label = "close it",
     .action = [](C c) { c.state.window.show_shortcuts = c.state.window.show_welcome = false; },
     .joined = true},
    {.command = Command::Quit,
     .chord = with_ctrl(letter("Q")),
     .label = "quit",
     .action = [](C c) { c.requests.quit = true; }},

    {.chord = gesture("Ctrl+click on a slider"), .label = "type a value", .section = "Settings"},
    {.chord = gesture("Right-click"), .label = "reset a setting, or copy it as --set"},
    {.chord = gesture("Arrows, Space, Enter"), .label = "from widget to widget, press, edit"},
    {.chord = gesture("Double-click a splitter"), .label = "as wide as at first"},
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
    switch (when) {
        case When::Always:
        case When::PopupOpen:
        case When::Flying:
        case When::HandleDragged:
            return when;
        default:
            return When::Ready;
    }
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
