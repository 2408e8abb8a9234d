// Reader for text on the screen, from glyph quads of Dear ImGui.
#include "tests/ui/drawn_text.h"

#include "renderer/base/key.h"
#include "tests/support/text.h"

namespace si::test {

/// Returns a key of a glyph's two opposite corners in the atlas.
std::uint64_t DrawnText::place(const ImVec2& lo, const ImVec2& hi) {
    Key key;
    return key.add(lo.x).add(lo.y).add(hi.x).add(hi.y).value();
}

DrawnText::DrawnText() {
    ImVector<ImFont*>& fonts = ImGui::GetIO().Fonts->Fonts;
    missing_.reserve(std::size_t(fonts.Size));
    for (ImFont* font : fonts) {
        for (const ImFontGlyph& g : font->Glyphs)
            if (g.Visible) letters_.emplace(place({g.U0, g.V0}, {g.U1, g.V1}), char32_t(g.Codepoint));
        ImFontGlyph missing = *font->FallbackGlyph;
        missing.Visible = 1;
        missing.U0 = missing.V0 = 2;
        missing.U1 = missing.V1 = 3;  // a position outside the atlas
        missing_.push_back(missing);
        font->FallbackGlyph = &missing_.back();
    }
    letters_.emplace(place({2, 2}, {3, 3}), U'\ufffd');
}

std::vector<DrawnText::Letter> DrawnText::letters() const {
    std::vector<Letter> out;
    const ImDrawData* data = ImGui::GetDrawData();
    for (int list = 0; data && list < data->CmdListsCount; ++list) {
        const ImDrawList& drawn = *data->CmdLists[list];
        const ImVector<ImDrawVert>& v = drawn.VtxBuffer;
        std::vector<ImVec4> clips(std::size_t(v.Size));
        for (const ImDrawCmd& command : drawn.CmdBuffer)
            for (unsigned i = 0; i < command.ElemCount; ++i)
                clips[drawn.IdxBuffer[int(command.IdxOffset + i)] + command.VtxOffset] = command.ClipRect;
        for (int i = 0; i + 3 < v.Size;) {
            const ImVec2 lo = v[i].uv, hi = v[i + 2].uv;
            const auto found = lo.x < hi.x ? letters_.find(place(lo, hi)) : letters_.end();
            const ImVec4& clip = clips[std::size_t(i)];
            const ImVec2 a = v[i].pos, b = v[i + 2].pos;
            constexpr float kOverhang = 1;  // overhang of the first letter of a line, pixels
            const bool whole = a.x >= clip.x - kOverhang && a.y >= clip.y && b.x <= clip.z + kOverhang && b.y <= clip.w;
            if (found != letters_.end()) out.push_back({found->second, a, b, whole});
            i += found != letters_.end() ? 4 : 1;
        }
    }
    return out;
}

std::u32string DrawnText::read() const {
    std::u32string text;
    for (const Letter& l : letters()) text += l.letter;
    return text;
}

bool DrawnText::shows(std::u32string_view text) const {
    const std::vector<Letter> all = letters();
    for (std::size_t i = 0; i + text.size() <= all.size(); ++i) {
        std::size_t same = 0;
        while (same < text.size() && all[i + same].letter == text[same] && all[i + same].whole) ++same;
        if (same == text.size()) return true;
    }
    return false;
}

bool DrawnText::shows(const std::string& ascii) const {
    std::u32string text;
    for (const char c : ascii)
        if (c != ' ') text += char32_t(static_cast<unsigned char>(c));
    return shows(text);
}

std::optional<ImVec2> DrawnText::find(std::u32string_view text, int which) const {
    const std::vector<Letter> all = letters();
    for (std::size_t i = 0; i + text.size() <= all.size(); ++i) {
        std::size_t same = 0;
        while (same < text.size() && all[i + same].letter == text[same] && all[i + same].whole &&
               (same == 0 || all[i + same].lo.x >= all[i + same - 1].lo.x))
            ++same;
        if (same < text.size() || which-- > 0) continue;
        const Letter &first = all[i], &last = all[i + same - 1];
        return ImVec2((first.lo.x + last.hi.x) / 2, (first.lo.y + last.hi.y) / 2);
    }
    return {};
}

std::string DrawnText::fault() const {
    return text_fault(read());
}

}  // namespace si::test
