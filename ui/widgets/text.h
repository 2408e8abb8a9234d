// Texts in a colour, a weight, a table cell or right-aligned; plain tooltips; buttons that can be disabled.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

#include "ui/widgets/theme.h"

namespace si {

/// Draws text in one line, in a colour.
inline void coloured_text(std::string_view text, ImU32 colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopStyleColor();
}

/// Draws text in a colour, in lines as wide as the window.
inline void coloured_wrapped(const std::string& text, ImU32 colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
}

/// Draws bold text, for headings.
inline void strong_text(std::string_view text) {
    ImGui::PushFont(theme::strong());
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopFont();
}

/// Draws text in the table's next column.
inline void text_cell(std::string_view text, ImU32 colour = theme::text()) {
    ImGui::TableNextColumn();
    coloured_text(text, colour);
}

/// Draws text at the right end of the free width.
inline void right_aligned(const std::string& text, ImU32 colour = theme::text()) {
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    coloured_text(text, colour);
}

/// Draws right-aligned text in the table's next column.
inline void right_cell(const std::string& text, ImU32 colour = theme::text()) {
    ImGui::TableNextColumn();
    right_aligned(text, colour);
}

/// Draws the tooltip of the last item, in the lines that the text has. @param flags ImGuiHoveredFlags
inline void plain_tooltip(const std::string& text, ImGuiHoveredFlags flags = 0) {
    if (ImGui::IsItemHovered(flags)) ImGui::SetTooltip("%s", text.c_str());
}

/// Draws a button that can only be pressed while `enabled`. Returns true at a press.
inline bool button_if(bool enabled, const char* label) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label);
    ImGui::EndDisabled();
    return pressed;
}

}  // namespace si
