// What an item says while the mouse is over it.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <string>

namespace si {

inline constexpr float kTooltipGap = 0.3f, kTooltipWidth = 31;  ///< beside its item, and at most, ems

/// Places the next tooltip so that it hides no neighbour of the last item: beside a narrow window as a list or a column
/// of settings, below or above the item in a wide one as a toolbar. Where there is no room for either: as ImGui does.
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

/// Of the last item, in lines of readable length; also where it is disabled.
inline void wrapped_tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    place_tooltip();
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace si
