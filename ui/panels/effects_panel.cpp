// What the frame did: each pass, whether it ran and why, what it cost.
#include <fmt/format.h>
#include <imgui.h>

#include "ui/state/panels.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

void right_aligned(const std::string& text, ImU32 colour = theme::kText) {
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (free > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + free);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

std::string grouped(std::uint64_t n) {
    std::string text = fmt::format("{}", n);
    for (int at = int(text.size()) - 3; at > 0; at -= 3) text.insert(std::size_t(at), "\u2009");
    return text;
}

void state_cell(PassState state) {
    switch (state) {
        case PassState::Ran:
            ImGui::TextUnformatted("ran");
            break;
        case PassState::Reused:
            ImGui::TextDisabled("reused");
            break;
        case PassState::Skipped:
            ImGui::TextDisabled("skipped");
            break;
    }
}

}  // namespace

void draw_passes(const EditorFrame& frame) {
    if (!frame.result) {
        ImGui::TextDisabled("No frame yet.");
        return;
    }
    const FrameResult& result = *frame.result;
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersInnerH |
                                      ImGuiTableFlags_NoSavedSettings;
    const float em = ImGui::GetFontSize();
    const float footer = ImGui::GetTextLineHeightWithSpacing() * (result.pages ? 2 : 1) + em * 0.2f;
    if (ImGui::BeginTable("passes", 7, flags, {0, -footer})) {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("Pass", ImGuiTableColumnFlags_WidthFixed, em * 12.5f);
        ImGui::TableSetupColumn("State", ImGuiTableColumnFlags_WidthFixed, em * 4.5f);
        ImGui::TableSetupColumn("Why", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("Time ms", ImGuiTableColumnFlags_WidthFixed, em * 5);
        ImGui::TableSetupColumn("CPU ms", ImGuiTableColumnFlags_WidthFixed, em * 5);
        ImGui::TableSetupColumn("Draws", ImGuiTableColumnFlags_WidthFixed, em * 4);
        ImGui::TableSetupColumn("Triangles", ImGuiTableColumnFlags_WidthFixed, em * 6);
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        for (int column = 0; column < 7; ++column) {
            ImGui::TableSetColumnIndex(column);
            ImGui::PushID(column);
            if (column < 3)
                ImGui::TextDisabled("%s", ImGui::TableGetColumnName(column));
            else
                right_aligned(ImGui::TableGetColumnName(column), theme::kMuted);
            ImGui::PopID();
        }
        double gpu = 0, cpu = 0;
        std::uint64_t draws = 0, triangles = 0;
        for (const PassInfo& pass : result.passes) {
            const bool ran = pass.state == PassState::Ran;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::PushStyleColor(ImGuiCol_Text, ran ? theme::kText : theme::kMuted);
            ImGui::TextUnformatted(pass.name.c_str());
            ImGui::PopStyleColor();
            ImGui::TableNextColumn();
            state_cell(pass.state);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", pass.reason.c_str());
            if (ImGui::IsItemHovered() && !pass.reason.empty()) ImGui::SetTooltip("%s", pass.reason.c_str());
            for (const double ms : {pass.gpu_ms, pass.cpu_ms}) {
                ImGui::TableNextColumn();
                if (ran && ms > 0) right_aligned(fmt::format("{:.2f}", ms));
            }
            for (const std::uint64_t n : {pass.draws, pass.triangles}) {
                ImGui::TableNextColumn();
                if (ran && n > 0) right_aligned(grouped(n));
            }
            if (ran) gpu += pass.gpu_ms, cpu += pass.cpu_ms, draws += pass.draws, triangles += pass.triangles;
        }
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushFont(theme::strong());
        ImGui::TextUnformatted("Frame");
        for (int column = 3; column < 7; ++column) {
            ImGui::TableSetColumnIndex(column);
            right_aligned(column == 3   ? fmt::format("{:.2f}", gpu)
                          : column == 4 ? fmt::format("{:.2f}", cpu)
                          : column == 5 ? grouped(draws)
                                        : grouped(triangles));
        }
        ImGui::PopFont();
        ImGui::EndTable();
    }
    if (result.pages) ImGui::TextDisabled("%s", page_text(*result.pages).c_str());
    std::string clock = result.clock.empty() ? std::string() : fmt::format("Time by {}", result.clock);
    if (frame.driver) {
        clock += fmt::format("{}{}", clock.empty() ? "" : "   ", frame.driver->renderer);
        if (frame.driver->software) clock += "   (a CPU rasteriser: times say nothing about a GPU)";
    }
    ImGui::TextDisabled("%s", clock.c_str());
}

}  // namespace si
