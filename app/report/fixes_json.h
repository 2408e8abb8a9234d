// Table of measured fixes as JSON and as text (docs/cli.md).
#pragma once

#include <string>

#include "app/base/json_text.h"
#include "renderer/advise/fixes.h"
#include "renderer/profiles/engine_wording.h"

namespace si {

/// Converts changes of settings to a JSON object {key: value}. @param changes pairs of setting key and new value
nlohmann::ordered_json changes_json(const std::vector<std::pair<std::string, std::string>>& changes);
/// Converts a change of the frame time to JSON {difference, noise, told}, in milliseconds. `told` is true if the
/// difference exceeds its noise.
nlohmann::ordered_json change_json(const CostChange& ms);
/// Converts a table of measured fixes (changes of settings against wrong pixels) to JSON: one object a row, in the
/// table's order.
/// @param engine engine whose changed bias parameters each row contains as "engine"; without a profile: none
nlohmann::ordered_json fixes_json(const FixTable& table, const EngineWording& engine = {});
/// Converts a parameter of another engine, with the number converted from this program's settings, to JSON {value,
/// unit, exactness, texels, metres}.
nlohmann::ordered_json written_parameter_json(const ConvertedParameter& parameter);
/// Converts changes of settings to changes of an engine's bias parameters, as JSON {profile, text, parameters}. Null if
/// `engine` has no profile, or if no bias parameter changes.
/// @param changes pairs of setting key and new value
nlohmann::ordered_json engine_changes_json(const EngineWording& engine,
                                           const std::vector<std::pair<std::string, std::string>>& changes);

/// Formats the number of changes that a search for fixes left out because the engine lacks them: "12 changes that
/// three.js lacks were not tried".
std::string refused_text(std::size_t count, const EngineWording& engine);

/// Prints a table of measured fixes (changes of settings against wrong pixels) to stdout: the best fix, then the
/// changes that help. Changes that were not tried are listed with the reason.
/// @param rows largest number of helpful changes to print @param engine engine whose changed bias parameters are
/// printed, too; without a profile: none
void print_fixes(const FixTable& table, std::size_t rows, const EngineWording& engine = {});

}  // namespace si
