// Files of a bundle in memory.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace si {

/// Name of the file at the top of a bundle that names all others.
inline constexpr std::string_view kFrameJson = "frame.json";

/// Contents of the files of a bundle by their paths in it.
using BundleContents = std::map<std::string, std::string>;

}  // namespace si
