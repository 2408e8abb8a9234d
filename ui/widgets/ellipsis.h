// Texts cut to a width, with an ellipsis where something is missing.
#pragma once

#include <imgui.h>

#include <cfloat>
#include <string>

namespace si {

inline float text_width(const std::string& text, const ImFont* font) {
    return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text.c_str()).x;
}

/// Inside a character of UTF-8.
inline bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// Of a sentence its beginning matters most. @param width pixels
inline std::string beginning_that_fits(std::string text, float width, const ImFont* font) {
    if (text_width(text, font) <= width) return text;
    while (!text.empty() && text_width(text + "…", font) > width) {
        while (is_continuation(text.back())) text.pop_back();
        text.pop_back();
    }
    return text + "…";
}

/// Of a path the file's name matters most. @param width pixels
inline std::string end_that_fits(std::string text, float width, const ImFont* font) {
    if (text_width(text, font) <= width) return text;
    for (std::size_t at = 1; at < text.size(); ++at)
        if (const std::string end = "…" + text.substr(at); !is_continuation(text[at]) && text_width(end, font) <= width)
            return end;
    return "…";
}

}  // namespace si
