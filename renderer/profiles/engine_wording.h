// Texts that speak in an engine's parameters: changes of settings, and settings found by an engine's names.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "renderer/profiles/engine_profile.h"
#include "renderer/settings/param.h"

namespace si {

/// Engine in whose parameters texts speak, with the settings and the map that they are about.
struct EngineWording {
    const EngineProfile* profile = nullptr;  ///< null: none, and all texts are empty
    MapFacts facts;
    Settings settings;  ///< before any change

    /// Returns the parameters of the bias that changes of settings, key and value, give another number.
    std::vector<WrittenParameter> changed(std::span<const std::pair<std::string, std::string>> changes) const;
    /// Formats the same: "in three.js: set normalBias to 0.0098". Empty where no parameter changes.
    std::string text(std::span<const std::pair<std::string, std::string>> changes) const;
};

/// Returns true when a setting has the name of an engine's parameter. Case does not matter.
bool engine_name_matches(const SettingRef& ref, std::string_view text);
/// Returns one line for each parameter of an engine that a setting stands for, with its conversion: "three.js
/// normalBias (m): Shift of ... 1 m = 102 texels at W 20 m, N 2048".
/// @param name only parameters with this name; empty: all @param only engine; null: all
std::vector<std::string> engine_names_of(const SettingRef& ref, std::string_view name = {},
                                         const EngineProfile* only = nullptr);
/// Returns the equivalent depth bias in texels of an engine's bias parameters at the reference angle, hidden bias
/// included. @throws Error as read_engine_values(); also for a profile without conversions
double engine_bias_texels(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts);

}  // namespace si
