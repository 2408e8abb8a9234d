// Right-aligned text, for numbers in tables.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/widgets/theme.h"

namespace si {

/// Draws text at the right end of the free width.
inline void right_aligned(const std::string& text, ImU32 colour = theme::text()) {
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

/// Draws right-aligned text in the table's next column.
inline void right_cell(const std::string& text, ImU32 colour = theme::text()) {
    ImGui::TableNextColumn();
    right_aligned(text, colour);
}

}  // namespace si
