// Texts in a colour, a weight, a table cell or right-aligned; plain tooltips; buttons that can be disabled.
#pragma once

#include <imgui.h>
#include <imgui_stdlib.h>

#include <string>
#include <string_view>

#include "ui/widgets/ellipsis.h"
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

/// Draws small text over a picture or plot. @param at upper left corner, pixels of the screen @param align share of the
/// text's width left of that place
inline void small_text(ImVec2 at, const std::string& text, ImU32 colour, float align = 0) {
    ImFont* const font = theme::small();
    if (align > 0) at.x -= align * text_width(text, font);
    ImGui::GetWindowDrawList()->AddText(font, font->FontSize, at, colour, text.c_str());
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

/// Draws a button with a tooltip. Returns true at a press.
inline bool hint_button(const char* label, const std::string& hint, bool enabled = true) {
    const bool pressed = button_if(enabled, label);
    plain_tooltip(hint, ImGuiHoveredFlags_AllowWhenDisabled);
    return pressed;
}

/// Draws a button that looks pressed while `on`. Returns true at a press.
inline bool toggle_button(const char* label, bool on, ImVec2 size = {0, 0}) {
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (on) ImGui::PushStyleColor(ImGuiCol_Text, theme::accent());
    const bool pressed = ImGui::Button(label, size);
    if (on) ImGui::PopStyleColor(2);
    return pressed;
}

/// Draws a text field for a path, and the button that accepts the path as Enter does. Closes the popup around them and
/// returns true once a path is accepted.
inline bool path_input(const char* id, const char* hint, std::string& path, const char* button) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 18);
    const bool entered = ImGui::InputTextWithHint(id, hint, &path, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    const bool accepted = (ImGui::Button(button) || entered) && !path.empty();
    if (accepted) ImGui::CloseCurrentPopup();
    return accepted;
}

}  // namespace si
