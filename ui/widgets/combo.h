// Combos that a press opens at once, and whose text ends in an ellipsis where its room does.
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <string>

#include "ui/widgets/ellipsis.h"

namespace si {

/// The press is on the last item, but closes a menu or a list that is open elsewhere: ImGui lets it do nothing else.
inline bool pressed_beside_popup() {
    return ImGui::IsMouseClicked(ImGuiMouseButton_Left) && ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup) &&
           !ImGui::GetTopMostPopupModal() && !ImGui::IsItemHovered() &&
           ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByPopup);
}

/// ImGui::BeginCombo(), which `EndCombo()` follows where it returns true. The press that closes another list opens this
/// one.
inline bool begin_combo(const char* label, const std::string& shown, ImGuiComboFlags flags = 0) {
    const float room = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - ImGui::GetStyle().FramePadding.x;
    if (ImGui::BeginCombo(label, beginning_that_fits(shown, room, ImGui::GetFont()).c_str(), flags)) return true;
    if (ImGui::GetCurrentWindow()->SkipItems) return false;  // the last item is another one
    // The list comes in the next frame: all lists share a window, in which that of the closed one may stand by now.
    if (pressed_beside_popup()) ImGui::OpenPopup(ImHashStr("##ComboPopup", 0, ImGui::GetItemID()));
    return false;
}

}  // namespace si
