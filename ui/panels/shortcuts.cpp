// The overview of mouse and keyboard.
#include <imgui.h>

#include "ui/state/panels.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr std::pair<const char*, const char*> kShortcuts[] = {
    {"Drag", "turn the camera about its target"},
    {"Middle drag, Shift+drag", "move the camera sideways"},
    {"Wheel", "closer, farther, towards the cursor"},
    {"Right button held", "fly: look with the mouse, W A S D move, Q E sink and rise; Shift faster, wheel: speed"},
    {"Drag a handle of the light", "change it; Ctrl in round steps, Esc as it was"},
    {"Click another light's mark", "show its map and handles"},
    {"Ctrl+drag", "turn the light"},
    {"Click", "probe a pixel; Esc forgets it"},
    {"Arrows after a click", "move the probe by a pixel, with Shift by 10; Tab or Esc: widgets have them again"},
    {"G", "loupe: on the probed pixel, under the mouse, off"},
    {"Double-click", "select an object; Esc twice: none"},
    {"Right click in the scene", "menu of the object under the mouse: frame, hide, isolate, cast, receive, culling"},
    {"H, Shift+H, Alt+H", "hide the selected objects, hide all others, show all"},
    {"Click, Ctrl+click, Shift+click a row of Objects", "select it, one more or less, all between"},
    {"Click an end of the axes", "look along that axis"},
    {"F", "frame the selected object, or the whole scene"},
    {"L", "look through the light, and back"},
    {"K", "freeze this view and fly about with another; its frustum stays"},
    {"Home", "the scene's own camera"},
    {"Space", "play or pause the animation"},
    {"1 to 9", "overlays; the same key again, or 0: none"},
    {"M", "map viewer: raw, linear, bands"},
    {"N", "shadow map: above the settings, beside the scene, inset, hidden"},
    {"B", "compare the picture with the truth or another preset: swipe, side by side, difference"},
    {"P", "pin the present settings as A, for Compare and to flicker to; the same settings again: take the pin off"},
    {"A held", "the picture under the pinned settings, alone"},
    {"X",
     "the camera to the next cluster of wrong pixels, largest first, and probe it; the tab Error chooses the cause"},
    {"C", "apply the fix that the probed pixel's verdict names"},
    {"U", "all bias away, to look for the least anew"},
    {"T", "the shown light: directional, spot, point"},
    {"F2", "rename the shown light, as a double-click in the list of lights does"},
    {"[ and ]", "half, twice the resolution of the map"},
    {"Q", "stored-depth quads around the texel of the pixel under the mouse, else of the probed one; again: none"},
    {", and .", "move the swipe's line; Shift: farther"},
    {"F11", "the panel under the mouse fills the window; again, or Esc: all of them"},
    {"Double-click a splitter", "as wide as at first"},
    {"Arrows, Space, Enter", "go from widget to widget, press, edit"},
    {"Ctrl+Z, Ctrl+Y", "undo, redo"},
    {"Page down, Page up", "the next, the previous guided preset"},
    {"Ctrl+O", "open a scene or a preset"},
    {"Ctrl+S, Ctrl+Shift+S", "save the preset, save it as"},
    {"Ctrl+R", "back to the preset as it was saved"},
    {"Ctrl+Shift+C", "copy the command line"},
    {"F12, Shift+F12, Ctrl+F12",
     "screenshot of the scene, of the map, of the window, as PNG beside the preset and to paste"},
    {"Ctrl+click on a slider", "type a value"},
    {"Right-click on a setting", "reset it, or copy it as --set"},
    {"Wheel, drag, double-click in the map", "zoom, move, fit"},
    {"Drop a file on the window", "open a .gltf or .glb scene, or a preset"},
    {"Ctrl+Q", "quit"},
};

}  // namespace

void draw_shortcuts(EditorState& state) {
    constexpr const char* kTitle = "Mouse and keyboard";
    if (state.show_shortcuts && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(kTitle, &state.show_shortcuts, ImGuiWindowFlags_AlwaysAutoResize)) return;
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings)) {
        for (const auto& [keys, meaning] : kShortcuts) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::PushFont(theme::strong());
            ImGui::TextUnformatted(keys);
            ImGui::PopFont();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(meaning);
        }
        ImGui::EndTable();
    }
    if (!state.show_shortcuts) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace si
