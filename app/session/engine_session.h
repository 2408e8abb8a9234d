// Settings typed in another engine's parameters: --profile NAME and --set engine.PARAMETER=VALUE.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/profiles/engine_profile.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Beginning of a key that is a parameter of the engine.
inline constexpr std::string_view kEnginePrefix = "engine.";

/// Engine profile of a session, with the values that are given in the engine's parameters.
struct EngineSession {
    const EngineProfile* profile = nullptr;  ///< null: none
    EngineValues values;
    std::optional<double> angle_deg;  ///< engine.angle: reference angle of conversions
    bool gives_bias = false;          ///< a value of `values` is one of the bias
};

/// Removes assignments of the engine's parameters from those of --set and returns them as an engine's session.
/// @param profile name of the profile; empty: none
/// @throws UsageError for an unknown profile, parameter or value, for a setting that the profile fixes, and for
/// engine.* without a profile
EngineSession take_engine_sets(const std::string& profile, std::vector<std::string>& sets);

/// Returns the facts of the map of view.light: of a bundle's map, else as its fit gives them for a picture of 16:9. The
/// first cascade counts. @throws Error for a bundle that cannot be read
MapFacts map_facts(const Scene& scene, const Settings& settings);

/// Applies a profile to the composed settings of a posed scene: what the engine cannot turn off, then its values.
/// Without values, preset and own bias the engine's defaults of bias, filter and casters apply.
/// @param has_preset the settings come from a preset @param sets assignments of --set, which win over the engine's
/// defaults @returns notes: what is not exact, what is replaced, what the engine lacks @throws Error, UsageError
std::vector<std::string> apply_engine(const EngineSession& engine, const Scene& scene, bool has_preset,
                                      std::span<const std::string> sets, Settings& settings);

}  // namespace si
