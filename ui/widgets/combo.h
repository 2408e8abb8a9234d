// Combos that open at the first press, with an ellipsis in texts that do not fit.
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "ui/widgets/text.h"

namespace si {

/// Returns true if a mouse press on the last ImGui item has just closed another popup. ImGui does not pass this press
/// on to the item, so callers handle it.
inline bool press_closed_other_popup() {
    return ImGui::IsMouseClicked(ImGuiMouseButton_Left) && ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup) &&
           !ImGui::GetTopMostPopupModal() && !ImGui::IsItemHovered() &&
           ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByPopup);
}

/// Draws a combo as ImGui::BeginCombo() does; if it returns true, call ImGui::EndCombo(). Unlike ImGui's combo, this
/// one also opens at a press that closes another combo's list.
inline bool begin_combo(const char* label, const std::string& shown, ImGuiComboFlags flags = 0) {
    const float room = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - ImGui::GetStyle().FramePadding.x;
    if (ImGui::BeginCombo(label, beginning_that_fits(shown, room, ImGui::GetFont()).c_str(), flags)) return true;
    if (ImGui::GetCurrentWindow()->SkipItems) return false;  // the last item is another one
    // The list comes in the next frame: all lists share a window, in which that of the closed one may stand by now.
    if (press_closed_other_popup()) ImGui::OpenPopup(ImHashStr("##ComboPopup", 0, ImGui::GetItemID()));
    return false;
}

/// Choice in a combo box: value, label and tooltip.
struct ComboItem {
    int value;
    std::string_view label;
    std::string_view help = {};  ///< tooltip; empty: none
};

/// Draws a combo of choices. Returns true if `value` has changed. @param unknown text for a value that is no choice
inline bool item_combo(const char* id, std::span<const ComboItem> items, int& value, const std::string& unknown = {}) {
    const auto now = std::ranges::find(items, value, &ComboItem::value);
    if (!begin_combo(id, now != items.end() ? std::string(now->label) : unknown)) return false;
    const int before = value;
    for (const ComboItem& item : items) {
        ImGui::PushID(item.value);
        const bool selected = item.value == before;
        if (ImGui::Selectable(std::string(item.label).c_str(), selected)) value = item.value;
        if (selected) ImGui::SetItemDefaultFocus();
        if (!item.help.empty()) wrapped_tooltip(std::string(item.help));
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return value != before;
}

}  // namespace si
