// Files of version 1, kept as that version wrote them, and what it took for granted.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "renderer/settings/settings.h"

namespace si::test {

/// Every setting's key with the default that it had, as --set takes it.
nlohmann::json version_1_defaults();

/// The guided presets of version 1, in their order.
std::vector<std::filesystem::path> version_1_presets();

/// What such a file says, spelled out without the program's own table: version 1's defaults of the lights that the file
/// speaks of and of all else, and the file's values over them.
Settings version_1_settings(const std::filesystem::path& preset);

}  // namespace si::test
