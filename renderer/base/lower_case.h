// Lower case for comparisons, of ASCII letters alone and in any locale.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace si {

/// Returns `text` with ASCII capitals in lower case; all other bytes stay.
inline std::string lower_ascii(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return out;
}

/// Returns the extension of a file name in lower case, with its dot: ".gltf".
inline std::string lower_extension(const std::filesystem::path& path) {
    return lower_ascii(path.extension().string());
}

}  // namespace si
