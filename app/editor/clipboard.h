// Pictures in the desktop's clipboard.
#pragma once

#include <filesystem>
#include <string>

namespace si {

/// Copies a PNG file to the desktop's clipboard (image/png) by xclip or wl-copy, because GLFW handles text only. The
/// picture stays available after this program has ended. Returns an error message; empty: the picture was copied.
std::string copy_png(const std::filesystem::path& png);

}  // namespace si
