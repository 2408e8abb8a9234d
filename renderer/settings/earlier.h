// Defaults of earlier versions. A file holds the settings that differ from the defaults of the version that wrote it,
// so a reader needs the defaults of that version.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "renderer/settings/param.h"

namespace si {

/// Version of all files that hold settings. It rises with each release that changes a default.
inline constexpr int kSettingsVersion = 2;

/// Default of a setting before a release changed it.
struct EarlierDefault {
    int version = kSettingsVersion;  ///< last version that had it
    std::string_view key;            ///< of the row; "light.X" for all lights
    std::string_view value;          ///< as set_setting() takes it
};

/// Returns the defaults that releases have changed, oldest first. Empty before the first release.
std::span<const EarlierDefault> earlier_defaults();

/// Replaces earlier_defaults() while it lives, so that a test reads files of versions that no release has written.
class TrialEarlierDefaults {
public:
    explicit TrialEarlierDefaults(std::span<const EarlierDefault> rows);
    ~TrialEarlierDefaults();
    TrialEarlierDefaults(const TrialEarlierDefaults&) = delete;
    TrialEarlierDefaults& operator=(const TrialEarlierDefaults&) = delete;

private:
    std::span<const EarlierDefault> before_;
};

/// Returns the oldest version of files that can be read: that of the oldest row of earlier_defaults().
int oldest_settings_version();
/// Returns the readable versions for a message: "version 2", "versions 2 to 3".
std::string readable_versions();

using SettingValue = std::pair<SettingRef, Value>;

/// Returns the number of lights that a file's values concern: light.count, and lights that have a value of their own.
int configured_light_count(std::span<const SettingValue> values);

/// Returns the settings that a file's values are written over: the defaults of its version.
/// @param lights lights that the file concerns (configured_light_count()); later ones begin with the present defaults
Settings defaults_of_version(int version, int lights = kMaxLights);

}  // namespace si
