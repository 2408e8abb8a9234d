// Welcome dialog of the first start.
#include <fmt/format.h>
#include <imgui.h>

#include "renderer/importers/importers.h"
#include "ui/state/panels.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/text.h"

namespace si {

void draw_welcome(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    constexpr const char* kTitle = "Welcome";
    constexpr const char* kSentences[] = {
        "Here a scene is shown next to its live shadow map, and every setting of the shadow is a slider.",
        "Click a pixel: it says why it is lit or in shadow, and whether that is right.",
        "Begin with a model of your own, with the guided presets from acne to cascades, or with the stage, a scene "
        "that has something of everything."};
    if (state.window.show_welcome && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    const float em = ImGui::GetFontSize();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(kTitle, &state.window.show_welcome, ImGuiWindowFlags_AlwaysAutoResize)) return;
    requests.welcomed = true;
    ImGui::PushTextWrapPos(em * 32);
    for (const char* sentence : kSentences) ImGui::TextUnformatted(sentence);
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0, em * 0.3f});
    const auto button = [&](const char* label, const char* help) {
        const bool pressed = ImGui::Button(label);
        plain_tooltip(help);
        ImGui::SameLine();
        if (pressed) state.window.show_welcome = false;
        return pressed;
    };
    if (button("Open a model…",
               fmt::format("A file of {}; dropping one on the window does the same", importer_labels()).c_str()))
        open_file_dialog(state.files.dialog, FileDialog::Job::Open, state.files.preset_path);
    if (button("Guided tour",
               fmt::format("The first guided preset; {} goes on", key_text(Command::NextPreset)).c_str()) &&
        !frame.presets.empty())
        requests.load_preset = frame.presets.front().key;
    constexpr const char* kStage = "stage";
    const bool open = state.scene_name == kStage;
    if (button("Look at the stage",
               (open ? with_key("It is open: closes this", Command::CloseOverview) : "Opens it in place of this scene")
                   .c_str()) &&
        !open)
        requests.load_scene = kStage;
    if (!state.window.show_welcome) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace si
