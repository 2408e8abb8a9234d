// Defaults of earlier versions. A file holds the settings that differ from the defaults of the version that wrote it,
// so reading needs the defaults of that version.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "renderer/settings/param.h"

namespace si {

/// Version number written to all files that hold settings. Each release that changes a default increases it.
inline constexpr int kSettingsVersion = 3;

/// Default value of one setting before a release changed it.
struct EarlierDefault {
    int version = kSettingsVersion;  ///< last version with this default
    std::string_view key;            ///< key of the setting; "light.X" for all lights
    std::string_view value;          ///< text for set_setting()
};

/// Returns the table of former defaults that later versions have changed, oldest first. Only tests assign another
/// table, to read files of versions that no program has written.
std::span<const EarlierDefault>& earlier_defaults();

/// Returns the oldest readable version of settings files: the lowest version in earlier_defaults().
int oldest_settings_version();
/// Returns the readable versions of settings files as text for a message: "version 2", "versions 2 to 3".
std::string readable_versions();

/// Setting and the value that a file gives it.
using SettingValue = std::pair<SettingRef, Value>;

/// Returns the number of lights that a file's values configure: the larger of light.count and the last light with a
/// value, plus one.
int configured_light_count(std::span<const SettingValue> values);

/// Returns the default settings of a version of the program, the base on which a file of this version is applied.
/// @param lights number of lights with defaults of this version (configured_light_count()); further lights get the
/// present defaults
Settings defaults_of_version(int version, int lights = kMaxLights);

}  // namespace si
