// What an item says while the mouse is over it.
#pragma once

#include <imgui.h>

#include <string>

namespace si {

/// Of the last item, in lines of readable length; also where it is disabled.
inline void wrapped_tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace si
