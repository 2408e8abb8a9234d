// The text that is on the screen, read back from what Dear ImGui hands to the GPU: every glyph's quad names its letter.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace si::test {

class DrawnText {
public:
    /// After the fonts are in the atlas. Letters that a font lacks become ones that can be told.
    DrawnText();
    DrawnText(const DrawnText&) = delete;
    DrawnText& operator=(const DrawnText&) = delete;

    /// Of the last ImGui::Render(): all letters in the order of drawing, without spaces. Letters cut off at an edge are
    /// left out, ones that the font lacks are U+FFFD.
    std::u32string read() const;
    /// The middle of a text on the screen, written without spaces: the `which`-th of all, from 0. Letters that follow
    /// each other in a line count. Nothing where it is not drawn, or an edge cuts it.
    std::optional<ImVec2> find(std::u32string_view text, int which = 0) const;
    /// What is wrong with it; empty when nothing is.
    std::string fault() const;

    struct Letter {
        char32_t letter;
        ImVec2 lo, hi;  ///< on the screen
        bool whole;     ///< no edge of a panel, a list or a column cuts it
    };
    std::vector<Letter> letters() const;
    /// Whether a text, written without spaces, can be read in whole somewhere; it may go on in further lines.
    bool shows(std::u32string_view text) const;
    bool shows(const std::string& ascii) const;

private:
    static std::uint64_t place(const ImVec2& lo, const ImVec2& hi);
    std::unordered_map<std::uint64_t, char32_t> letters_;  ///< by two opposite corners of the glyph in the atlas
    std::vector<ImFontGlyph> missing_;                     ///< for each font
};

}  // namespace si::test
