// Text of frame.json, parsed and formatted.
#pragma once

#include <string>
#include <string_view>

#include "renderer/bundle/bundle.h"

namespace si {

/// Largest accepted size of frame.json, which describes a bundle (an engine's frame as files), in bytes.
inline constexpr std::size_t kMaxFrameJsonBytes = std::size_t{4} << 20;

/// Parses the text of frame.json, which describes one exported frame of an engine (a bundle).
/// @param text content of the file
/// @param file name of the file, for messages
/// @throws Error "FILE: PLACE: what is wrong; what to do" for anything that docs/bundle.md does not allow
Bundle parse_bundle(std::string_view text, std::string_view file);

/// Formats the description of a bundle (one exported frame of an engine) as the text of frame.json. Equal bundles give
/// equal bytes, and parse_bundle() returns an equal bundle. Members with their defaults are left out.
std::string format_bundle(const Bundle& bundle);

}  // namespace si
