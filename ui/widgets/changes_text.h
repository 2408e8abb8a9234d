// Lists of changed settings as panels print them: labels, and values with units.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "renderer/settings/settings.h"

namespace si {

/// Keys of settings with new values, for set_settings().
using ShownChanges = std::span<const std::pair<std::string, std::string>>;

/// Formats changes of settings for a tooltip, each on a line with its key: "Resolution: 512 texels   map.resolution".
/// @param settings before the changes @throws UsageError for a setting or value that does not exist
std::string changes_list(const Settings& settings, ShownChanges changes);

/// Formats changes of settings as one line for display: "Kernel: hard (nearest), Resolution: 512 texels".
/// @param settings before the changes @throws UsageError for a setting or value that does not exist
std::string changes_line(const Settings& settings, ShownChanges changes);

}  // namespace si
