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

/// Row of the table of former defaults: the default value that a setting had until a release changed it. Settings files
/// from before the change are read with this value.
struct EarlierDefault {
    int version = kSettingsVersion;  ///< last version with this default
    std::string_view key;            ///< key of the setting; "light.X" for all lights
    std::string_view value;          ///< text for set_setting()
};

/// Returns the table of former defaults, oldest first. Files with settings that earlier versions wrote are read with
/// these defaults. Only tests assign another table through the reference, to read files of versions that do not exist.
std::span<const EarlierDefault>& earlier_defaults();

/// Returns the lowest version of settings files that the program can read: the lowest version in earlier_defaults().
int oldest_settings_version();
/// Returns the readable versions of settings files as text for a message: "version 2", "versions 2 to 3".
std::string readable_versions();

/// Reference to a setting, and the value that a file gives the setting.
using SettingValue = std::pair<SettingRef, Value>;

/// Returns the number of lights that a settings file configures, for defaults_of_version(). It is the largest of 1,
/// light.count, and one more than the highest index of a light that has a value.
/// @param values all settings of the file with their values
int configured_light_count(std::span<const SettingValue> values);

/// Returns the default settings of a version of the program. A file of that version is applied on top of them, since
/// the file holds only settings that differ from its defaults.
/// @param lights number of lights that get the defaults of `version` (configured_light_count()); further lights get the
/// defaults of the running program
Settings defaults_of_version(int version, int lights = kMaxLights);

}  // namespace si
