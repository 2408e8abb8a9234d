// The overview of mouse and keyboard.
#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "ui/state/shortcuts.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// Line of the overview; without a meaning it is the heading of the lines below.
struct OverviewLine {
    std::string keys;
    std::string meaning;
};

/// Adds a text to a list, unless it is empty.
void append(std::string& list, std::string_view separator, std::string_view text) {
    if (text.empty()) return;
    if (!list.empty()) list += separator;
    list += text;
}

const std::vector<OverviewLine>& overview_lines() {
    static const std::vector<OverviewLine> kLines = [] {
        std::vector<OverviewLine> lines;
        for (const Shortcut& row : shortcuts()) {
            if (row.section) lines.push_back({row.section, {}});
            if (!row.joined) lines.emplace_back();
            append(lines.back().keys, ", ", chord_text(row.chord));
            append(lines.back().meaning, "; ", row.label);
        }
        return lines;
    }();
    return kLines;
}

/// Index of the heading nearest to the middle, at which the second of two columns begins.
std::size_t second_column() {
    const auto& lines = overview_lines();
    const std::size_t middle = lines.size() / 2;
    const auto distance = [middle](std::size_t i) { return i > middle ? i - middle : middle - i; };
    std::size_t best = lines.size();
    for (std::size_t i = 1; i < lines.size(); ++i)
        if (lines[i].meaning.empty() && distance(i) < distance(best)) best = i;
    return best;
}

/// Returns the largest width of the keys or the meanings in their font, pixels.
float column_width(std::string OverviewLine::*text, ImFont* font) {
    float width = 0;
    ImGui::PushFont(font);
    for (const OverviewLine& s : overview_lines())
        if (!s.meaning.empty()) width = std::max(width, ImGui::CalcTextSize((s.*text).c_str()).x);
    ImGui::PopFont();
    return width;
}

/// Draws one column of the overview. @param meanings width at which texts are wrapped, pixels
void column(std::size_t first, std::size_t end, float keys, float meanings) {
    ImGui::PushID(int(first));
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings)) {
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, keys);
        ImGui::TableSetupColumn("meaning", ImGuiTableColumnFlags_WidthFixed, meanings);
        for (std::size_t i = first; i < end; ++i) {
            const OverviewLine& s = overview_lines()[i];
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::PushFont(theme::strong());
            if (s.meaning.empty()) ImGui::PushStyleColor(ImGuiCol_Text, theme::accent());
            ImGui::TextUnformatted(s.keys.c_str());
            if (s.meaning.empty()) ImGui::PopStyleColor();
            ImGui::PopFont();
            ImGui::TableNextColumn();
            if (s.meaning.empty()) continue;
            ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + meanings);
            ImGui::TextUnformatted(s.meaning.c_str());
            ImGui::PopTextWrapPos();
        }
        ImGui::EndTable();
    }
    ImGui::PopID();
}

}  // namespace

void draw_shortcuts(bool& shown) {
    constexpr const char* kTitle = "Mouse and keyboard";
    if (shown && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, screen);
    if (!ImGui::BeginPopupModal(kTitle, &shown, ImGuiWindowFlags_AlwaysAutoResize)) return;
    const ImGuiStyle& style = ImGui::GetStyle();
    const ImVec2 padding = style.CellPadding;
    const float em = ImGui::GetFontSize();
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {padding.x, padding.y * 0.3f});
    const float keys = column_width(&OverviewLine::keys, theme::strong());
    const float wide = column_width(&OverviewLine::meaning, ImGui::GetFont());
    const float room = screen.x - 2 * style.WindowPadding.x - style.ScrollbarSize, column_gap = em;
    // In two columns keys are not wrapped, only texts.
    const float half = (room - column_gap) / 2 - keys - 4 * padding.x;
    const bool two = half > em * 14;
    const float meanings = std::min(wide, two ? half : std::max(room - keys - 4 * padding.x, em * 10));
    const std::size_t all = overview_lines().size();
    const std::size_t split = two ? second_column() : all;
    ImGui::BeginGroup();
    column(0, split, keys, meanings);
    ImGui::EndGroup();
    if (two) {
        ImGui::SameLine(0, column_gap);
        ImGui::BeginGroup();
        column(split, all, keys, meanings);
        ImGui::EndGroup();
    }
    ImGui::PopStyleVar();
    if (!shown) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace si
