// Pictures in the desktop's clipboard.
#pragma once

#include <filesystem>
#include <string>

namespace si {

/// Puts a PNG file into the desktop's clipboard (image/png) by xclip or wl-copy, because GLFW handles text only. These
/// programs keep offering the picture after this one has ended. Returns the reason of a failure, else "".
std::string copy_png(const std::filesystem::path& png);

}  // namespace si
