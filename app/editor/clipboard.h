// Pictures for other programs to paste.
#pragma once

#include <filesystem>
#include <string>

namespace si {

/// Offers a PNG file's bytes as the desktop's clipboard (image/png), by xclip or wl-copy, which go on offering them
/// when this program has ended: GLFW knows text alone. Returns why that was not possible, else "".
std::string copy_png(const std::filesystem::path& png);

}  // namespace si
