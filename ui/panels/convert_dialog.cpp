#include "ui/panels/convert_dialog.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <utility>

#include "ui/widgets/combo.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr const char* kConvertTitle = "Convert to another engine";
constexpr double kLargestAngleDeg = 89;

std::string target_label(std::span<const ConvertTargetLabel> targets, const std::string& name) {
    for (const ConvertTargetLabel& row : targets)
        if (row.name == name) return std::string(row.title);
    return name;
}

void draw_targets(ConvertDialog& dialog, std::span<const ConvertTargetLabel> targets, float width) {
    ImGui::SetNextItemWidth(width);
    if (!begin_combo("##target", target_label(targets, dialog.target), ImGuiComboFlags_HeightLarge)) return;
    for (const ConvertTargetLabel& row : targets)
        if (ImGui::Selectable(fmt::format("{}##{}", row.title, row.name).c_str(), row.name == dialog.target))
            dialog.target = row.name;
    ImGui::EndCombo();
}

void draw_angle(ConvertDialog& dialog, float width) {
    ImGui::SetNextItemWidth(width);
    auto angle = float(dialog.angle_deg);
    if (ImGui::SliderFloat("##angle", &angle, 0, float(kLargestAngleDeg), "reference angle %.0f°"))
        dialog.angle_deg = std::clamp(double(angle), 0.0, kLargestAngleDeg);
    plain_tooltip("Angle between normal and light at which numbers agree that cannot agree at every angle");
}

/// Draws the button that measures the scene, or the progress under its button Cancel.
void draw_measuring(const ConvertFacts& facts, ConvertRequests& requests) {
    const float width = ImGui::GetFontSize() * 6;
    if (facts.measuring) {
        requests.cancel_conversion |= ImGui::Button("Cancel", {width, 0});
        ImGui::SameLine();
        progress_bar(facts.measuring->progress, facts.measuring->about + ", " + progress_text(*facts.measuring));
        return;
    }
    requests.measure_conversion |= ImGui::Button("Measure", {width, 0});
    plain_tooltip(
        "Takes the angle from the picture (95 % of lit pixels are tilted less), compares it with the reference and "
        "times frames. The comments then state error and time.");
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled(facts.measured ? "The comments state error and time." : "Error and time are not measured.");
}

void draw_preview(const ConvertFacts& facts, float height) {
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::well());
    ImGui::BeginChild("preview", {0, height}, true, ImGuiWindowFlags_HorizontalScrollbar);
    const char* line = facts.text.c_str();
    ImGui::TextUnformatted(line, line + facts.text.size());
    ImGui::EndChild();
    ImGui::PopStyleColor();
}

/// Returns true if the typed path is the one that the last request found taken.
bool names_taken_file(const ConvertDialog& dialog, const ConvertFacts& facts) {
    return !dialog.output.empty() && dialog.output == facts.taken;
}

/// Draws the row with the file's path. Returns true where it is to be saved.
bool draw_output(ConvertDialog& dialog, const ConvertFacts& facts) {
    const float em = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(-em * 14);
    bool save = ImGui::InputTextWithHint("##output", "path of the file to write", &dialog.output,
                                         ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    ImGui::BeginDisabled(facts.text.empty());
    if (ImGui::Button("Copy", {em * 6, 0})) ImGui::SetClipboardText(facts.text.c_str());
    ImGui::SameLine();
    ImGui::BeginDisabled(dialog.output.empty());
    save |= ImGui::Button(names_taken_file(dialog, facts) ? "Replace" : "Save", {em * 6, 0});
    ImGui::EndDisabled();
    ImGui::EndDisabled();
    return save && !facts.text.empty() && !dialog.output.empty();
}

}  // namespace

void draw_convert_dialog(ConvertDialog& dialog, const ConvertFacts* facts, ConvertRequests& requests) {
    if (std::exchange(dialog.asked, false)) {
        ImGui::OpenPopup(kConvertTitle);
        dialog.shown = true;
    }
    const float em = ImGui::GetFontSize();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(em * 60, screen.x - 2 * em), std::min(em * 40, screen.y - 2 * em)});
    bool open = true;
    if (!ImGui::BeginPopupModal(kConvertTitle, &open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) {
        dialog.shown = false;
        return;
    }
    if (facts) {
        draw_targets(dialog, facts->targets, em * 20);
        ImGui::SameLine();
        draw_angle(dialog, -FLT_MIN);
        draw_measuring(*facts, requests);
        const float line = ImGui::GetTextLineHeightWithSpacing(), button = ImGui::GetFrameHeightWithSpacing();
        const float below = 2 * button + line * (float(facts->notes.size()) + (facts->problem.empty() ? 0 : 2));
        draw_preview(*facts, std::max(ImGui::GetContentRegionAvail().y - below, em * 4));
        const float width = ImGui::GetContentRegionAvail().x;
        for (const std::string& note : facts->notes) coloured_text(broken_at_spaces(note, width), theme::muted());
        if (!facts->problem.empty()) coloured_text(broken_at_spaces(facts->problem, width), theme::error());
        if (draw_output(dialog, *facts)) {
            requests.save_conversion = dialog.output;
            requests.replace_conversion = names_taken_file(dialog, *facts);
        }
    } else {
        ImGui::TextUnformatted("There is no frame yet.");
    }
    if (ImGui::Button("Close", {em * 6, 0}) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace si
