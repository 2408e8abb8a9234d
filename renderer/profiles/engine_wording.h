// Texts that speak in an engine's parameters: changes of settings, and settings found by an engine's names.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "renderer/profiles/engine_profile.h"
#include "renderer/settings/param.h"

namespace si {

/// Translator of setting changes into the parameters of an engine, for texts. Holds the engine, the present settings,
/// and the facts of the shadow map (width, resolution, format and others) on which the conversion depends.
struct EngineWording {
    const EngineProfile* profile = nullptr;  ///< null: none, and all texts are empty
    MapFacts facts;
    Settings settings;  ///< before any change

    /// Returns the engine's bias parameters that get another value when some settings change, with the new values.
    /// @param changes pairs of setting key and new value
    std::vector<ConvertedParameter> changed(std::span<const std::pair<std::string, std::string>> changes) const;
    /// Formats the change of the engine's bias parameters that follows from changed settings: "in three.js: set
    /// normalBias to 0.0098". Empty if no parameter changes.
    /// @param changes pairs of setting key and new value
    std::string text(std::span<const std::pair<std::string, std::string>> changes) const;
};

/// Returns true when a text is the name of a parameter of any engine that stands for the setting `ref`, ignoring case.
/// Used to find settings by the names of other engines.
bool engine_name_matches(const SettingRef& ref, std::string_view text);
/// Returns one line for each parameter of an engine that a setting stands for, with an example of its conversion:
/// "three.js normalBias (m): Shift of ... 0.02 = 2.9 texels = 0.0283 m at W 20 m, N 2048, D 40 m, 45 degrees".
/// @param name only parameters with this name; empty: all
/// @param only the only engine to list; null: all
std::vector<std::string> engine_names_of(const SettingRef& ref, std::string_view name = {},
                                         const EngineProfile* only = nullptr);
/// Returns the equivalent depth bias of all bias parameters of an engine, in texels: the depth bias that acts against
/// acne as much as they do, at the reference angle (MapFacts::angle_deg). The bias that the engine adds by itself is
/// included. The difference of two calls gives the equivalent of one parameter, for lists.
/// @throws Error as read_engine_values(); also for a profile without conversions
double engine_bias_texels(const EngineProfile& profile, const EngineValues& values, const MapFacts& facts);

}  // namespace si
