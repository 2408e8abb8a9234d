// Texts (coloured, bold, small, right-aligned, cut to a width), tooltips, buttons, text fields and tables.
#pragma once

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <initializer_list>
#include <string>
#include <string_view>

#include "ui/widgets/theme.h"

namespace si {

/// Returns the width of a text in a font, pixels.
inline float text_width(std::string_view text, const ImFont* font) {
    return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text.data(), text.data() + text.size()).x;
}

/// Returns true for the second and later bytes of a UTF-8 character.
inline bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// Cuts a text at its end, with an ellipsis, so that it fits a width; for sentences. @param width pixels
inline std::string beginning_that_fits(std::string text, float width, const ImFont* font) {
    if (text_width(text, font) <= width) return text;
    while (!text.empty() && text_width(text + "…", font) > width) {
        while (is_continuation(text.back())) text.pop_back();
        text.pop_back();
    }
    return text + "…";
}

/// Cuts a text at its beginning, with an ellipsis, so that it fits a width; for paths. @param width pixels
inline std::string end_that_fits(std::string text, float width, const ImFont* font) {
    if (text_width(text, font) <= width) return text;
    for (std::size_t at = 1; at < text.size(); ++at)
        if (const std::string end = "…" + text.substr(at); !is_continuation(text[at]) && text_width(end, font) <= width)
            return end;
    return "…";
}

/// Returns the width of an ImGui button with that label, pixels.
inline float button_width(const char* label) {
    return ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
}

inline constexpr float kTooltipGap = 0.3f;  ///< distance from the item, ems
inline constexpr float kTooltipWidth = 31;  ///< largest width, ems
inline constexpr float kTallItem = 5;       ///< height of an item that its tooltip may cover, ems

/// Places the next tooltip so that it covers no neighbour of the last item: next to a narrow window (a list, a column
/// of settings), below or above the item in a wide one (a toolbar). Leaves the placement to ImGui for tall items and
/// where there is no room.
/// @param width width of the tooltip, pixels; 0: the largest
inline void place_tooltip(float width = 0) {
    const float em = ImGui::GetFontSize(), gap = em * kTooltipGap, wide = width > 0 ? width : em * kTooltipWidth;
    const ImVec2 screen = ImGui::GetIO().DisplaySize, lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    const float left = ImGui::GetWindowPos().x, right = left + ImGui::GetWindowSize().x;
    const bool upper = lo.y + hi.y < screen.y;
    if (hi.y - lo.y > em * kTallItem) return;  // a splitter or a picture: beside the mouse
    if (right - left < em * kTooltipWidth) {
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

/// Returns true if the space at index `at` is between a number and its unit, which belong on one line: "3.1 m".
inline bool joins_unit(std::string_view text, std::size_t at) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    return at > 0 && at + 1 < text.size() && is_digit(text[at - 1]) && text[at + 1] != ' ' && !is_digit(text[at + 1]);
}

/// Breaks a text into lines at spaces only, and not between a number and its unit. ImGui would break after points, too,
/// as in "map.resolution" or "0.25". @param width largest width of a line, pixels
inline std::string broken_at_spaces(std::string_view text, float width) {
    std::string out;
    std::size_t line = 0, word = 0;  // where in `out` the last line and the last word begin
    const auto end_word = [&] {
        if (word == line || ImGui::CalcTextSize(out.c_str() + line).x <= width) return;
        out[word - 1] = '\n';
        line = word;
    };
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        const bool ends = c == '\n' || (c == ' ' && !joins_unit(text, at));
        if (ends) end_word();
        out += c;
        if (ends) word = out.size();
        if (c == '\n') line = word;
    }
    end_word();
    return out;
}

/// Draws the tooltip of the last item, even a disabled item, in lines of readable length.
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

/// Draws text in a colour. Lines break at the text's line breaks and at ImGui's wrap position.
inline void coloured_text(std::string_view text, ImU32 colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopStyleColor();
}

/// Draws text in lines as wide as the window or the column, and keeps each number on one line with its unit.
inline void wrapped_text(std::string_view text) {
    ImGui::PushTextWrapPos(0);  // for words longer than a line
    ImGui::TextUnformatted(broken_at_spaces(text, ImGui::GetContentRegionAvail().x - 1).c_str());
    ImGui::PopTextWrapPos();
}

/// Draws text in a colour, in lines as wide as the window or the column.
inline void coloured_wrapped(const std::string& text, ImU32 colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    wrapped_text(text);
    ImGui::PopStyleColor();
}

/// Scope (RAII) in which widgets are drawn in grey but stay clickable, for numbers of an earlier picture. Has no effect
/// if `on` is false.
class Greyed {
public:
    explicit Greyed(bool on) : on_(on) {
        const ImGuiStyle& style = ImGui::GetStyle();
        if (on_) ImGui::PushStyleVar(ImGuiStyleVar_Alpha, style.Alpha * style.DisabledAlpha);
    }
    ~Greyed() {
        if (on_) ImGui::PopStyleVar();
    }
    Greyed(const Greyed&) = delete;
    Greyed& operator=(const Greyed&) = delete;

private:
    bool on_;
};

/// Draws bold text, for headings.
inline void strong_text(std::string_view text) {
    ImGui::PushFont(theme::strong());
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopFont();
}

/// Draws a heading.
inline void heading_text(std::string_view text) {
    ImGui::PushFont(theme::heading());
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopFont();
}

/// Draws a value, in the font for values, in the next column of the current ImGui table.
inline void value_cell(std::string_view text, ImU32 colour = theme::text()) {
    ImGui::TableNextColumn();
    ImGui::PushFont(theme::value());
    coloured_text(text, colour);
    ImGui::PopFont();
}

/// Draws help text: small, muted, in lines as wide as the window or the column.
inline void help_text(const std::string& text) {
    ImGui::PushFont(theme::small());
    coloured_wrapped(text, theme::muted());
    ImGui::PopFont();
}

/// Column of an ImGui table for begin_table(): heading and width.
struct TableColumn {
    const char* heading;
    float ems = 0;    ///< fixed width, ems; 0: not fixed
    float share = 0;  ///< weight in the free width; 0: the table's flags decide
};

/// Begins a table with striped rows and a row of headings that does not scroll; if it returns true, call
/// ImGui::EndTable().
inline bool begin_table(const char* id, ImGuiTableFlags flags, std::initializer_list<TableColumn> columns) {
    flags |= ImGuiTableFlags_RowBg | ImGuiTableFlags_NoSavedSettings;
    if (!ImGui::BeginTable(id, int(columns.size()), flags)) return false;
    if (flags & ImGuiTableFlags_ScrollY) ImGui::TableSetupScrollFreeze(0, 1);
    for (const TableColumn& c : columns) {
        const int stretches = c.share > 0 ? ImGuiTableColumnFlags_WidthStretch : ImGuiTableColumnFlags_None;
        const bool fixed = c.ems > 0;
        ImGui::TableSetupColumn(c.heading, fixed ? int(ImGuiTableColumnFlags_WidthFixed) : stretches,
                                fixed ? c.ems * ImGui::GetFontSize() : c.share);
    }
    ImGui::TableHeadersRow();
    return true;
}

/// Draws a selectable as wide as the column, with its label broken into lines. Returns true when it was pressed.
inline bool wrapped_selectable(const std::string& label, bool selected) {
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = ImGui::CalcTextSize(label.c_str(), nullptr, false, width).y;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed =
        ImGui::Selectable(("##" + label).c_str(), selected, ImGuiSelectableFlags_None, {width, height});
    ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at, ImGui::GetColorU32(ImGuiCol_Text),
                                        label.c_str(), nullptr, width);
    return pressed;
}

/// Draws text in the next column of the current ImGui table.
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

/// Draws right-aligned text in the next column of the current ImGui table.
inline void right_cell(const std::string& text, ImU32 colour = theme::text()) {
    ImGui::TableNextColumn();
    right_aligned(text, colour);
}

/// Draws small text over a picture or plot. @param at upper left corner, pixels of the screen @param align share of the
/// text's width left of `at`; 0.5: centred
inline void small_text(ImVec2 at, const std::string& text, ImU32 colour, float align = 0) {
    ImFont* const font = theme::small();
    if (align > 0) at.x -= align * text_width(text, font);
    ImGui::GetWindowDrawList()->AddText(font, font->FontSize, at, colour, text.c_str());
}

/// Draws the tooltip of the last item, with line breaks only where the text has them. @param flags ImGuiHoveredFlags
inline void plain_tooltip(const std::string& text, ImGuiHoveredFlags flags = 0) {
    if (!ImGui::IsItemHovered(flags)) return;
    place_tooltip(ImGui::CalcTextSize(text.c_str()).x + 2 * ImGui::GetStyle().WindowPadding.x);
    ImGui::SetTooltip("%s", text.c_str());
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

/// Draws a search field over the free width, with a button that clears it. @param hint text of the empty field
/// @param leave the pixels to leave free to the right of the field @param about an addition to the field's tooltip,
/// such as "; other engines' names count too"
inline void search_field(const char* id, const char* hint, std::string& text, float leave, const char* about = "") {
    const float width = std::max(ImGui::GetContentRegionAvail().x - leave, ImGui::GetFontSize() * 3);
    const float side = ImGui::GetFrameHeight();
    const bool clears = !text.empty();
    ImGui::PushID(id);
    ImGui::SetNextItemWidth(clears ? width - side : width);
    const float room = width - 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::InputTextWithHint("##text", beginning_that_fits(hint, room, ImGui::GetFont()).c_str(), &text);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
        ImGui::SetTooltip("All words have to be there, in any order%s", about);
    if (clears) {
        ImGui::SameLine(0, 0);
        if (ImGui::Button("×", {side, side})) text.clear();
        plain_tooltip("Clears the search");
    }
    ImGui::PopID();
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
