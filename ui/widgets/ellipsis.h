// Texts cut to a width, with an ellipsis for the missing part.
#pragma once

#include <imgui.h>

#include <cfloat>
#include <string>

namespace si {

/// Returns the width of a text in a font, pixels.
inline float text_width(const std::string& text, const ImFont* font) {
    return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text.c_str()).x;
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

}  // namespace si
