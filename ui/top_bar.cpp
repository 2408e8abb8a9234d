// Scene, preset, undo.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <string>

#include "renderer/scenes/builtin.h"
#include "ui/panels.h"
#include "ui/playback.h"
#include "ui/theme.h"

namespace si {
namespace {

bool button(const char* label, const char* hint, bool enabled = true) {
    if (!enabled) ImGui::BeginDisabled();
    const bool pressed = ImGui::Button(label);
    if (!enabled) ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", hint);
    return pressed;
}

void scene_combo(EditorState& state, EditorActions& actions, float width) {
    ImGui::SetNextItemWidth(width);
    if (!ImGui::BeginCombo("##scene", scene_label(state.scene_name).c_str(), ImGuiComboFlags_HeightLarge)) return;
    for (const BuiltinScene& scene : builtin_scenes()) {
        const std::string key(scene.key), label(scene.label);
        if (ImGui::Selectable((label + "##" + key).c_str(), key == state.scene_name)) actions.load_scene = key;
        if (ImGui::IsItemHovered() && !scene.help.empty()) ImGui::SetTooltip("%s", std::string(scene.help).c_str());
    }
    ImGui::Separator();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 18);
    const bool entered = ImGui::InputTextWithHint("##path", "path of a .gltf or .glb file", &state.scene_input,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if ((ImGui::Button("Open") || entered) && !state.scene_input.empty()) {
        actions.load_scene = state.scene_input;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndCombo();
}

void preset_menu(const EditorFrame& frame, EditorActions& actions) {
    if (ImGui::Button("Presets")) ImGui::OpenPopup("presets");
    if (!ImGui::BeginPopup("presets")) return;
    for (const PresetEntry& preset : frame.presets) {
        if (ImGui::Selectable(preset.key.c_str())) actions.load_preset = preset.key;
        if (ImGui::IsItemHovered() && !preset.about.empty()) ImGui::SetTooltip("%s", preset.about.c_str());
    }
    if (frame.presets.empty()) ImGui::TextDisabled("No presets ship with this build.");
    ImGui::EndPopup();
}

}  // namespace

std::string scene_label(const std::string& name) {
    if (name.empty()) return "No scene";
    for (const BuiltinScene& scene : builtin_scenes())
        if (scene.key == name) return std::string(scene.label);
    const auto slash = name.find_last_of('/');
    return slash == std::string::npos ? name : name.substr(slash + 1);
}

void draw_top_bar(EditorState& state, const EditorFrame& frame, EditorActions& actions) {
    const float em = ImGui::GetFontSize();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("Scene");
    ImGui::SameLine();
    scene_combo(state, actions, em * 11);
    ImGui::SameLine(0, em * 1.5f);
    ImGui::TextDisabled("Preset");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(em * 12);
    ImGui::InputTextWithHint("##preset", "file name", &state.preset_path);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("The file that Save writes and Open reads");
    ImGui::SameLine();
    const bool named = !state.preset_path.empty();
    if (button("Open", "Read the settings from this file (Ctrl+O)", named)) actions.load_preset = state.preset_path;
    ImGui::SameLine();
    if (button("Save", "Write the settings to this file (Ctrl+S)", named)) actions.save_preset = state.preset_path;
    ImGui::SameLine();
    preset_menu(frame, actions);
    ImGui::SameLine(0, em * 1.5f);
    if (button("Undo", "Ctrl+Z", state.history.can_undo() || state.playback.playing)) undo(state);
    ImGui::SameLine();
    if (button("Redo", "Ctrl+Y", state.history.can_redo())) redo(state);
    ImGui::SameLine(0, em * 1.5f);
    if (button("Copy command line", "The command that renders this picture without a window"))
        actions.copy_command_line = true;
    const char* help = "Help";
    const float width = ImGui::CalcTextSize(help).x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine(
        std::max(ImGui::GetWindowWidth() - width - ImGui::GetStyle().WindowPadding.x, ImGui::GetCursorPosX()));
    if (button(help, "Mouse and keyboard (F1)")) state.show_shortcuts = true;
}

}  // namespace si
