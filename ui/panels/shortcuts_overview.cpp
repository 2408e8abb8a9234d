// The overview of mouse and keyboard.
#include <imgui.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "ui/state/panels.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// A line of the overview; without a meaning the heading of those that follow.
struct Shortcut {
    const char *keys, *meaning;
};

constexpr Shortcut kShortcuts[] = {
    {"Look", nullptr},
    {"Drag, Ctrl+drag", "turn the camera about its target, turn the light"},
    {"Middle drag, Shift+drag", "move the camera sideways"},
    {"Wheel", "closer, farther, towards the cursor"},
    {"Right button held", "fly: W A S D move, Q E sink and rise; Shift faster, wheel: speed"},
    {"F, Home", "frame what is selected or the scene; the scene's own camera"},
    {"L, K", "through the light and back; freeze this view and fly with another"},
    {"Click an end of the axes", "look along that axis"},
    {"F11 or double-click a title", "that panel alone, and back"},
    {"N", "where the map stands"},
    {"M, wheel, drag, double-click", "map: raw, linear, bands; zoom, move, fit"},

    {"Why", nullptr},
    {"Click", "probe a pixel; Esc forgets it"},
    {"Arrows after a click", "the probe by a pixel, with Shift by 10; Tab: widgets have them"},
    {"G", "loupe: on the probed pixel, under the mouse, off"},
    {"X", "to the next cluster of wrong pixels (cause: tab Error), and probe it"},
    {"C, U", "apply the verdict's fix; all bias away"},
    {"Q", "stored-depth quads at the mouse or the probe; again: none"},
    {"1 to 9, 0", "overlays, more with Shift, Alt or Ctrl (their list has the keys); again, or 0: none"},

    {"Compare", nullptr},
    {"B", "with the truth or a preset: swipe, side by side, difference"},
    {", and .", "move the swipe's line; Shift: farther"},
    {"P, A held", "pin the present settings as A, or take the pin off; A alone"},

    {"Lights", nullptr},
    {"Drag a handle", "change the light; Ctrl in round steps, Esc as it was"},
    {"Click another light's mark", "show its map and handles"},
    {"T, F2", "the shown light: directional, spot, point; rename it"},
    {"[ and ]", "half, twice the resolution of the map"},

    {"Objects", nullptr},
    {"Double-click", "select an object; Esc twice: none"},
    {"Right click", "its menu: frame, hide, isolate, cast, receive, culling"},
    {"H, Shift+H, Alt+H", "hide the selected ones, hide all others, show all"},
    {"Ctrl+click, Shift+click", "in Objects: one more or less, all between"},
    {"Space", "play or pause the animation"},

    {"Files and steps", nullptr},
    {"Ctrl+O, or drop a file", "open a .gltf or .glb scene, or a preset"},
    {"Ctrl+S, Ctrl+Shift+S", "save the preset, save it as"},
    {"Ctrl+R", "back to the preset as it was saved"},
    {"Page down, Page up", "the next, the previous guided preset"},
    {"Ctrl+Z, Ctrl+Y", "undo, redo"},
    {"Ctrl+Shift+C", "copy the command line"},
    {"F12, Shift+F12, Ctrl+F12", "screenshot of scene, map, window: PNG and clipboard"},
    {"Ctrl+Q", "quit"},

    {"Settings", nullptr},
    {"Ctrl+click on a slider", "type a value"},
    {"Right-click", "reset a setting, or copy it as --set"},
    {"Arrows, Space, Enter", "from widget to widget, press, edit"},
    {"Double-click a splitter", "as wide as at first"},
};

constexpr std::size_t kAll = std::size(kShortcuts);

/// Where the second of two columns begins: at the heading nearest to the middle.
std::size_t second_column() {
    std::size_t best = kAll;
    const auto off = [](std::size_t at) { return at > kAll / 2 ? at - kAll / 2 : kAll / 2 - at; };
    for (std::size_t i = 1; i < kAll; ++i)
        if (!kShortcuts[i].meaning && off(i) < off(best)) best = i;
    return best;
}

float width_of_keys() {
    float width = 0;
    ImGui::PushFont(theme::strong());
    for (const Shortcut& s : kShortcuts)
        if (s.meaning) width = std::max(width, ImGui::CalcTextSize(s.keys).x);
    ImGui::PopFont();
    return width;
}

float width_of_meanings() {
    float width = 0;
    for (const Shortcut& s : kShortcuts)
        if (s.meaning) width = std::max(width, ImGui::CalcTextSize(s.meaning).x);
    return width;
}

/// @param meanings width that the texts are wrapped at
void column(std::size_t first, std::size_t end, float keys, float meanings) {
    ImGui::PushID(int(first));
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings)) {
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, keys);
        ImGui::TableSetupColumn("meaning", ImGuiTableColumnFlags_WidthFixed, meanings);
        for (std::size_t i = first; i < end; ++i) {
            const Shortcut& s = kShortcuts[i];
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::PushFont(theme::strong());
            if (!s.meaning) ImGui::PushStyleColor(ImGuiCol_Text, theme::accent());
            ImGui::TextUnformatted(s.keys);
            if (!s.meaning) ImGui::PopStyleColor();
            ImGui::PopFont();
            ImGui::TableNextColumn();
            if (!s.meaning) continue;
            ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + meanings);
            ImGui::TextUnformatted(s.meaning);
            ImGui::PopTextWrapPos();
        }
        ImGui::EndTable();
    }
    ImGui::PopID();
}

}  // namespace

void draw_shortcuts(EditorState& state) {
    constexpr const char* kTitle = "Mouse and keyboard";
    if (state.show_shortcuts && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, screen);
    if (!ImGui::BeginPopupModal(kTitle, &state.show_shortcuts, ImGuiWindowFlags_AlwaysAutoResize)) return;
    const ImGuiStyle& style = ImGui::GetStyle();
    const ImVec2 padding = style.CellPadding;
    const float em = ImGui::GetFontSize();
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {padding.x, padding.y * 0.3f});
    const float keys = width_of_keys(), wide = width_of_meanings();
    const float room = screen.x - 2 * style.WindowPadding.x - style.ScrollbarSize, column_gap = em;
    // Two columns need their keys in full; their texts wrap where they must.
    const float half = (room - column_gap) / 2 - keys - 4 * padding.x;
    const bool two = half > em * 14;
    const float meanings = std::min(wide, two ? half : std::max(room - keys - 4 * padding.x, em * 10));
    const std::size_t split = two ? second_column() : kAll;
    ImGui::BeginGroup();
    column(0, split, keys, meanings);
    ImGui::EndGroup();
    if (two) {
        ImGui::SameLine(0, column_gap);
        ImGui::BeginGroup();
        column(split, kAll, keys, meanings);
        ImGui::EndGroup();
    }
    ImGui::PopStyleVar();
    if (!state.show_shortcuts) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace si
