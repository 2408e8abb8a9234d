#include "ui/panels/import_dialog.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>

#include "ui/state/scene_choices.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr const char* kWarningTitle = "Open a RenderDoc capture?";
constexpr const char* kLightTitle = "Import the image of a map";
constexpr const char* kChoosingTitle = "Choose the shadow maps";
constexpr const char* kReadingTitle = "Choose how the map is read";

/// Returns the title of the dialog of a step; null: the step has none.
const char* title_of(const ImportFacts& facts) {
    switch (facts.step) {
        case ImportStep::Warning:
            return kWarningTitle;
        case ImportStep::Light:
            return kLightTitle;
        case ImportStep::Choosing:
            return facts.is_capture ? kChoosingTitle : kReadingTitle;
        case ImportStep::Reading:
        case ImportStep::Writing:
            break;
    }
    return nullptr;
}

bool is_picked(const ImportDialog& dialog, int number) {
    return std::ranges::find(dialog.picks, number) != dialog.picks.end();
}

/// Draws a text field for a path with its label above it. Returns true at Enter.
bool path_field(const char* label, const char* hint, std::string& path) {
    ImGui::TextUnformatted(label);
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::PushID(label);
    const bool entered = ImGui::InputTextWithHint("##path", hint, &path, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PopID();
    return entered;
}

/// Draws one map of a capture with its box.
void draw_map_choice(ImportDialog& dialog, const ImportChoice& choice) {
    bool picked = is_picked(dialog, choice.number);
    bool changed = ImGui::Checkbox("##picked", &picked);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const std::string text = fmt::format("{}: {}", choice.number, choice.text);
    ImGui::TextUnformatted(broken_at_spaces(text, ImGui::GetContentRegionAvail().x).c_str());
    if (ImGui::IsItemClicked()) {
        picked = !picked;
        changed = true;
    }
    if (!changed) return;
    if (picked)
        dialog.picks.push_back(choice.number);
    else
        std::erase(dialog.picks, choice.number);
}

/// Draws one reading of an image, of which one is chosen.
void draw_reading_choice(ImportDialog& dialog, const ImportChoice& choice) {
    ImGui::BeginDisabled(!choice.usable);
    if (ImGui::RadioButton(fmt::format("{}: {}", choice.number, choice.text).c_str(), is_picked(dialog, choice.number)))
        dialog.picks = {choice.number};
    ImGui::EndDisabled();
    ImGui::Indent();
    coloured_text(broken_at_spaces(choice.fit, ImGui::GetContentRegionAvail().x),
                  choice.fits ? theme::text() : theme::muted());
    ImGui::Unindent();
}

void draw_choices(ImportDialog& dialog, const ImportFacts& facts, float height) {
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::well());
    ImGui::BeginChild("choices", {0, height}, true);
    for (const ImportChoice& choice : facts.choices) {
        ImGui::PushID(choice.number);
        if (facts.is_capture)
            draw_map_choice(dialog, choice);
        else
            draw_reading_choice(dialog, choice);
        ImGui::PopID();
    }
    ImGui::EndChild();
    ImGui::PopStyleColor();
}

void draw_warning() {
    ImGui::TextUnformatted(
        "Opening a capture replays its commands, which runs its shaders on this machine. A helper process with limits "
        "of memory and time does that. Open captures only from people whom you trust. This is said once.");
}

/// Draws the fields of the light. Returns true at Enter.
bool draw_light(ImportDialog& dialog, const std::string& scene) {
    ImGui::TextUnformatted(
        "The file of the light holds its matrices, as docs/bundle.md describes. Conventions that it does not state are "
        "found by comparing the map with the scene.");
    const bool entered = path_field("File of the light", "path of a .json file", dialog.light);
    ImGui::Checkbox(fmt::format("Compare with the shown scene, {}", scene_label(scene)).c_str(), &dialog.over_scene);
    plain_tooltip("Without a scene the map's own surface is shown");
    return entered;
}

/// Draws the choices and the path of the bundle. Returns true at Enter.
bool draw_choosing(ImportDialog& dialog, const ImportFacts& facts) {
    const float em = ImGui::GetFontSize();
    ImGui::TextUnformatted(scene_label(facts.file).c_str());
    if (facts.is_capture) {
        ImGui::SameLine();
        if (ImGui::SmallButton("All")) {
            dialog.picks.clear();
            for (const ImportChoice& choice : facts.choices) dialog.picks.push_back(choice.number);
        }
        ImGui::SameLine();
        if (ImGui::SmallButton("None")) dialog.picks.clear();
    }
    const float rows = facts.is_capture ? 2.7f : 4.2f;
    draw_choices(dialog, facts, std::clamp(float(facts.choices.size()) * rows, 4.0f, 20.0f) * em);
    return path_field("Bundle to write", "path that ends in .bundle", dialog.output);
}

}  // namespace

void draw_import_dialog(ImportDialog& dialog, const std::optional<ImportFacts>& facts, const std::string& scene,
                        ImportRequests& requests) {
    const char* const title = facts ? title_of(*facts) : nullptr;
    if (title && !ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
    const float em = ImGui::GetFontSize();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    for (const char* const each : {kWarningTitle, kLightTitle, kChoosingTitle, kReadingTitle}) {
        ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
        const float width = std::min(em * 46, screen.x - 2 * em);
        ImGui::SetNextWindowSizeConstraints({width, 0}, {width, screen.y - 2 * em});
        if (!ImGui::BeginPopupModal(each, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
            continue;
        if (each != title) {
            ImGui::CloseCurrentPopup();
            ImGui::EndPopup();
            continue;
        }
        ImGui::PushTextWrapPos(width - em);
        const bool choosing = facts->step == ImportStep::Choosing;
        bool done = false;
        if (facts->step == ImportStep::Warning) draw_warning();
        if (facts->step == ImportStep::Light) done = draw_light(dialog, scene);
        if (choosing) done = draw_choosing(dialog, *facts);
        if (!facts->problem.empty()) coloured_text(facts->problem, theme::error());
        ImGui::PopTextWrapPos();
        done |= ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) && !ImGui::GetIO().NavVisible;
        const bool ready = !choosing || (!dialog.picks.empty() && !dialog.output.empty());
        ImGui::BeginDisabled(!ready);
        done |= ImGui::Button(facts->step == ImportStep::Light ? "Compare" : "Open", {em * 6, 0});
        ImGui::EndDisabled();
        ImGui::SameLine();
        const bool cancelled =
            ImGui::Button("Cancel", {em * 6, 0}) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
        requests.cancel_import |= cancelled;
        if (done && ready && !cancelled) (choosing ? requests.write_import : requests.start_import) = true;
        ImGui::EndPopup();
    }
}

void draw_import_progress(const std::optional<ImportFacts>& facts, float left, float top, float width,
                          ImportRequests& requests) {
    if (!facts || title_of(*facts)) return;
    const std::string text = fmt::format("{}: {} … {} %, {} s", scene_label(facts->file), facts->doing,
                                         int(std::clamp(facts->progress, 0.0, 1.0) * 100), int(facts->seconds));
    if (progress_strip("import", left, width, top + ImGui::GetFontSize() * 5, 40, facts->progress, text))
        requests.cancel_import = true;
}

}  // namespace si
