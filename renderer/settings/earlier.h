// What files of earlier versions mean by what they leave out. A file that holds settings holds those that differ from
// the defaults, and the version that the defaults are of.
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include "renderer/settings/param.h"

namespace si {

/// The version of all files that hold settings. It rises with each release of which a default differs from before.
inline constexpr int kSettingsVersion = 2;

/// A default as it was.
struct EarlierDefault {
    int version = 1;         ///< the last one that had it
    std::string_view key;    ///< of the row; "light.X" for all lights
    std::string_view value;  ///< as set_setting() takes it
};
std::span<const EarlierDefault> earlier_defaults();

using SettingValue = std::pair<SettingRef, Value>;

/// How many lights these values of a file speak of: those that shine, and those that have a value of their own.
int lights_of(std::span<const SettingValue> values);

/// What the values of a file of this version are written over.
/// @param lights how many the file speaks of; those beyond it begin with today's defaults
Settings defaults_of_version(int version, int lights = kMaxLights);

}  // namespace si
