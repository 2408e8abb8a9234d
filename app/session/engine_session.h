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

/// Prefix of a key in an option --set that names a parameter of another engine.
inline constexpr std::string_view kEnginePrefix = "engine.";

/// Engine profile that the user has chosen, with the values that the command line gives in the engine's own parameters.
struct EngineSession {
    const EngineProfile* profile = nullptr;  ///< null: none
    EngineValues values;
    std::optional<double> angle_deg;  ///< engine.angle: reference angle of conversions
    bool gives_bias = false;          ///< `values` has a parameter of the bias
};

/// Removes the assignments "engine.PARAMETER=VALUE" from the --set assignments, and returns them with the engine's
/// profile.
/// @param profile name of the engine profile; empty: none @param sets --set assignments; engine.* is removed
/// @throws UsageError for an unknown profile, parameter or value, for an assignment of a setting whose value the
/// profile dictates, and for engine.* without a profile
EngineSession take_engine_sets(const std::string& profile, std::vector<std::string>& sets);

/// Returns width, depth range and texels of the shadow map of the light that view.light selects, for conversions to an
/// engine's parameters. They come from the imported map, if the settings name a bundle (files of an engine's frame)
/// with one. Otherwise the light's map is fitted to the scene, for a picture of 16:9. Of several cascades the first
/// counts.
/// @throws Error for a bundle that cannot be read
MapFacts map_facts(const Scene& scene, const Settings& settings);

/// Changes settings so that the program draws as another engine does. First it sets what the engine cannot turn off,
/// then the values of the engine's parameters. Without a preset, parameters without a value take the engine's defaults
/// for filter, casters, map format and bias. The default bias gives way to bias settings of --set.
/// @param scene posed scene @param has_preset the settings come from a preset
/// @param sets assignments of --set, which win over the engine's defaults @param settings settings to change, composed
/// from preset, scene and --set
/// @returns notes: what is not exact, what is replaced, what the engine lacks @throws Error, UsageError
std::vector<std::string> apply_engine(const EngineSession& engine, const Scene& scene, bool has_preset,
                                      std::span<const std::string> sets, Settings& settings);

}  // namespace si
