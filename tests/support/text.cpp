#include "tests/support/text.h"

#include <algorithm>

namespace si::test {
namespace {

constexpr char32_t kBroken = 0xfffd;
// Characters of the bytes 80 to 9f in code page 1252: the second half of letters misread by that page.
constexpr std::u32string_view kCp1252 =
    U"\u20ac\u201a\u0192\u201e\u2026\u2020\u2021\u02c6\u2030\u0160\u2039\u0152\u017d\u2018\u2019\u201c\u201d\u2022"
    U"\u2013"
    U"\u2014\u02dc\u2122\u0161\u203a\u0153\u017e\u0178";

/// Returns whether a character is a continuation byte of UTF-8, read as Latin-1 or code page 1252.
bool continues(char32_t c) {
    return (c >= 0x80 && c <= 0xbf) || kCp1252.find(c) != std::u32string_view::npos;
}

}  // namespace

std::string utf8(char32_t c) {
    if (c < 0x80) return {char(c)};
    const auto tail = [c](int shift) { return char(0x80 | (c >> shift & 0x3f)); };
    if (c < 0x800) return {char(0xc0 | c >> 6), tail(0)};
    if (c < 0x10000) return {char(0xe0 | c >> 12), tail(6), tail(0)};
    return {char(0xf0 | c >> 18), tail(12), tail(6), tail(0)};
}

std::u32string code_points(std::string_view text) {
    std::u32string out;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t more = lead < 0x80                   ? 0
                                 : lead >= 0xc2 && lead < 0xe0 ? 1
                                 : lead >= 0xe0 && lead < 0xf0 ? 2
                                 : lead >= 0xf0 && lead < 0xf5 ? 3
                                                               : 9;
        char32_t c = more == 0 ? lead : lead & (0x3f >> more);
        bool whole = i + more < text.size() && more < 9;
        for (std::size_t k = 1; whole && k <= more; ++k) {
            const auto b = static_cast<unsigned char>(text[i + k]);
            whole = (b & 0xc0) == 0x80;
            c = c << 6 | (b & 0x3f);
        }
        // Rejected: overlong forms, halves of a pair, and values above the last code point.
        whole = whole && utf8(c).size() == more + 1 && !(c >= 0xd800 && c < 0xe000) && c < 0x110000;
        out += whole ? c : kBroken;
        i += whole ? more + 1 : 1;
    }
    return out;
}

std::string lacking(std::string_view text, std::initializer_list<std::string_view> parts) {
    for (const std::string_view part : parts)
        if (text.find(part) == text.npos) return "\"" + std::string(part) + "\" is missing in: " + std::string(text);
    return {};
}

std::string text_fault(const std::u32string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char32_t c = text[i], next = i + 1 < text.size() ? text[i + 1] : U' ';
        const bool twice = c >= 0xc2 && c <= 0xf4 && c != 0xd7 && c != 0xf7 && continues(next);
        if (c != kBroken && !twice) continue;
        std::string around;
        for (std::size_t k = i < 20 ? 0 : i - 20; k < std::min(text.size(), i + 20); ++k) around += utf8(text[k]);
        return (twice ? "encoded twice: \"" : "no UTF-8: \"") + around + "\"";
    }
    return {};
}

std::string text_fault(std::string_view text) {
    return text_fault(code_points(text));
}

}  // namespace si::test
