// Texts without capitals, to be compared. ASCII alone: other bytes stay as they are, in any locale.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace si {

inline std::string in_small_letters(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return out;
}

/// The file's extension in small letters, with its dot.
inline std::string lower_extension(const std::filesystem::path& path) {
    return in_small_letters(path.extension().string());
}

}  // namespace si
