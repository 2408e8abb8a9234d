// Files of a bundle in memory.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace si {

/// Name of the file at the top of a bundle (an engine's frame as files) that describes the frame and names all other
/// files.
inline constexpr std::string_view kFrameJson = "frame.json";

/// Files of a bundle (an engine's frame) in memory: content by path in the bundle.
using BundleContents = std::map<std::string, std::string>;

}  // namespace si
