// Reader for text on the screen. Each glyph quad that Dear ImGui hands to the GPU gives its letter.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace si::test {

/// Text of the last ImGui frame, read from glyph quads. Needs a current ImGui context.
class DrawnText {
public:
    /// Indexes the glyphs of the font atlas, which must be complete. Letters missing in a font get a recognisable
    /// placeholder.
    DrawnText();
    DrawnText(const DrawnText&) = delete;
    DrawnText& operator=(const DrawnText&) = delete;

    /// Returns all letters of the last ImGui::Render() in drawing order, without spaces. Letters cut off at an edge are
    /// left out; letters missing in the font are U+FFFD.
    std::u32string read() const;
    /// Returns the centre in pixels of the `which`-th (from 0) occurrence of a text, which is given without spaces.
    /// Letters must be neighbours in one line. Returns nothing if the text is not drawn or cut off.
    std::optional<ImVec2> find(std::u32string_view text, int which = 0) const;
    /// Returns an encoding fault of the drawn text; empty without one.
    std::string fault() const;

    /// One drawn letter and its box on the screen.
    struct Letter {
        char32_t letter;
        ImVec2 lo, hi;  ///< corners on the screen, pixels
        bool whole;     ///< true unless an edge of a panel, a list or a column cuts the letter
    };
    /// Returns all drawn letters, cut ones included.
    std::vector<Letter> letters() const;
    /// Returns whether a text is readable in full somewhere. The text is given without spaces and may continue in
    /// further lines.
    bool shows(std::u32string_view text) const;
    /// Returns whether an ASCII text, spaces aside, is readable in full somewhere.
    bool shows(const std::string& ascii) const;

private:
    static std::uint64_t place(const ImVec2& lo, const ImVec2& hi);
    std::unordered_map<std::uint64_t, char32_t> letters_;  ///< letters by two opposite glyph corners in the atlas
    std::vector<ImFontGlyph> missing_;                     ///< placeholder glyph of each font
};

}  // namespace si::test
