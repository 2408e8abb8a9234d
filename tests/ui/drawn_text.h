// The text that is on the screen, read back from what Dear ImGui hands to the GPU: every glyph's quad names its letter.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <string>
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
    /// What is wrong with it; empty when nothing is.
    std::string fault() const;

private:
    static std::uint64_t place(const ImVec2& lo, const ImVec2& hi);
    std::unordered_map<std::uint64_t, char32_t> letters_;  ///< by two opposite corners of the glyph in the atlas
    std::vector<ImFontGlyph> missing_;                     ///< for each font
};

}  // namespace si::test
