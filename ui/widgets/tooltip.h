// Tooltips that cover no neighbour of their item.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace si {

inline constexpr float kTooltipGap = 0.3f;  ///< distance from the item, ems
inline constexpr float kTooltipWidth = 31;  ///< largest width, ems

/// Places the next tooltip so that it covers no neighbour of the last item: next to a narrow window (a list, a column
/// of settings), below or above the item in a wide one (a toolbar). Without room for either ImGui places it.
inline void place_tooltip() {
    const float em = ImGui::GetFontSize(), gap = em * kTooltipGap, wide = em * kTooltipWidth;
    const ImVec2 screen = ImGui::GetIO().DisplaySize, lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    const float left = ImGui::GetWindowPos().x, right = left + ImGui::GetWindowSize().x;
    const bool upper = lo.y + hi.y < screen.y;
    if (right - left < wide) {
        const bool on_right = screen.x - right >= wide;
        if (!on_right && left < wide) return;
        ImGui::SetNextWindowPos({on_right ? right + gap : left - gap, upper ? lo.y : hi.y}, ImGuiCond_Always,
                                {on_right ? 0.0f : 1.0f, upper ? 0.0f : 1.0f});
    } else if (screen.x >= wide) {
        ImGui::SetNextWindowPos(
            {std::clamp(ImGui::GetMousePos().x, 0.0f, screen.x - wide), upper ? hi.y + gap : lo.y - gap},
            ImGuiCond_Always, {0, upper ? 0.0f : 1.0f});
    }
}

/// Breaks a text into lines at spaces only. ImGui would break after points, too, as in "map.resolution".
/// @param width largest width of a line, pixels
inline std::string broken_at_spaces(std::string_view text, float width) {
    std::string out;
    std::size_t line = 0, word = 0;  // where in `out` the last line and the last word begin
    const auto end_word = [&] {
        if (word == line || ImGui::CalcTextSize(out.c_str() + line).x <= width) return;
        out[word - 1] = '\n';
        line = word;
    };
    for (const char c : text) {
        const bool ends = c == ' ' || c == '\n';
        if (ends) end_word();
        out += c;
        if (ends) word = out.size();
        if (c == '\n') line = word;
    }
    end_word();
    return out;
}

/// Draws the tooltip of the last item, in lines of readable length, also if it is disabled.
inline void wrapped_tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    place_tooltip();
    ImGui::BeginTooltip();
    const float most = ImGui::GetFontSize() * 30;
    ImGui::PushTextWrapPos(most);
    ImGui::TextUnformatted(broken_at_spaces(text, most - ImGui::GetStyle().WindowPadding.x - 1).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace si
