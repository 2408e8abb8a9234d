#include "ui/panels/report_dialog.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "ui/widgets/combo.h"
#include "ui/widgets/progress_bar.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr const char* kReportTitle = "Report";

void add_preset(ReportDialog& dialog, const std::string& preset) {
    if (!preset.empty() && std::ranges::find(dialog.presets, preset) == dialog.presets.end())
        dialog.presets.push_back(preset);
}

void draw_preset_choice(ReportDialog& dialog, const PresetsFacts& presets) {
    const float em = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(em * 16);
    if (begin_combo("##add preset", "Add a preset…", ImGuiComboFlags_HeightLarge)) {
        for (const std::string& path : presets.recent_presets)
            if (ImGui::Selectable(path.c_str())) add_preset(dialog, path);
        for (const PresetEntry& entry : presets.presets)
            if (ImGui::Selectable(fmt::format("{}##{}", entry.title, entry.key).c_str())) add_preset(dialog, entry.key);
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-em * 6);
    bool add = ImGui::InputTextWithHint("##preset path", "or the path of one", &dialog.preset_input,
                                        ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    add |= button_if(!dialog.preset_input.empty(), "Add");
    if (add) add_preset(dialog, std::exchange(dialog.preset_input, {}));
}

void draw_subjects(ReportDialog& dialog, const PresetsFacts& presets, bool has_pinned) {
    strong_text("Compared settings");
    ImGui::BulletText("The present settings, whose view all are drawn in");
    if (has_pinned) ImGui::Checkbox("The pinned settings A", &dialog.pinned);
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < dialog.presets.size(); ++i) {
        ImGui::PushID(int(i));
        if (ImGui::SmallButton("Remove")) removed = i;
        ImGui::PopID();
        ImGui::SameLine();
        ImGui::TextUnformatted(dialog.presets[i].c_str());
    }
    if (removed) dialog.presets.erase(dialog.presets.begin() + std::ptrdiff_t(*removed));
    draw_preset_choice(dialog, presets);
}

}  // namespace

void draw_report_dialog(ReportDialog& dialog, const ReportFacts& facts, const PresetsFacts& presets, bool has_pinned,
                        const std::optional<glm::ivec2>& probed, ReportRequests& requests) {
    if (std::exchange(dialog.asked, false)) {
        ImGui::OpenPopup(kReportTitle);
        dialog.shown = true;
    }
    const float em = ImGui::GetFontSize();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(em * 44, screen.x - 2 * em), std::min(em * 24, screen.y - 2 * em)});
    bool open = true;
    if (!ImGui::BeginPopupModal(kReportTitle, &open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) {
        dialog.shown = false;
        return;
    }
    wrapped_text(
        "One page with pictures, wrong pixels, diagnosed pixels, numbers and commands that reproduce them, to attach "
        "to a bug.");
    draw_subjects(dialog, presets, has_pinned);
    if (probed)
        ImGui::Checkbox(fmt::format("Diagnose the probed pixel {},{} alone", probed->x, probed->y).c_str(),
                        &dialog.probed);
    else
        ImGui::TextDisabled("One pixel of each cause is diagnosed; probe a pixel to choose it.");
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-em * 7);
    bool write = ImGui::InputTextWithHint("##report output", "path of the page, .html", &dialog.output,
                                          ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if (facts.writing) {
        requests.cancel_report |= ImGui::Button("Cancel", {em * 6, 0});
        progress_bar(facts.writing->progress, progress_text(*facts.writing) + "  " + facts.writing->about);
    } else {
        const bool replaces = !dialog.output.empty() && dialog.output == facts.taken;
        ImGui::BeginDisabled(dialog.output.empty());
        write |= ImGui::Button(replaces ? "Replace" : "Write", {em * 6, 0});
        ImGui::EndDisabled();
        if (write && !dialog.output.empty())
            requests.write_report = ReportRequest{.output = dialog.output,
                                                  .pinned = has_pinned && dialog.pinned,
                                                  .replace = replaces,
                                                  .presets = dialog.presets,
                                                  .pixel = dialog.probed ? probed : std::nullopt};
    }
    if (!facts.problem.empty()) coloured_wrapped(facts.problem, theme::error());
    if (!facts.wrote.empty()) coloured_wrapped("Wrote " + facts.wrote, theme::muted());
    if (ImGui::Button("Close", {em * 6, 0}) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace si
