// Free names for bundles.
#pragma once

#include <filesystem>
#include <string>

namespace si {

/// Returns the path of a new bundle (a frame of an engine as files) in `folder` whose name is not in use: STEM.bundle,
/// else STEM-2.bundle and so on. Slashes, backslashes and colons of the stem become hyphens, so that the bundle lies in
/// the folder.
/// @param stem name without extension
std::filesystem::path free_bundle_path(const std::filesystem::path& folder, std::string stem);

}  // namespace si
