// Table of measured fixes as JSON and as text (docs/cli.md).
#pragma once

#include <string>

#include "app/base/json_text.h"
#include "renderer/advise/fixes.h"
#include "renderer/profiles/engine_wording.h"

namespace si {

/// Converts changes of settings, key and value, to a JSON object.
nlohmann::ordered_json changes_json(const std::vector<std::pair<std::string, std::string>>& changes);
/// Converts the change of a cost to JSON {difference, noise, told}.
nlohmann::ordered_json change_json(const CostChange& ms);
/// Converts a table of fixes to JSON: one object a row, in the table's order.
/// @param engine engine whose parameters each row names too, as "engine"
nlohmann::ordered_json fixes_json(const FixTable& table, const EngineWording& engine = {});
/// Converts a number of an engine to JSON {value, unit, exactness, texels, metres}.
nlohmann::ordered_json written_parameter_json(const WrittenParameter& parameter);
/// Converts changes of settings to changes of an engine's bias parameters, as JSON {profile, text, parameters}. Null
/// without a profile, or if no bias parameter changes.
nlohmann::ordered_json engine_changes_json(const EngineWording& engine,
                                           const std::vector<std::pair<std::string, std::string>>& changes);

/// Formats the number of changes that a search left out, since the engine lacks them: "12 changes that three.js lacks
/// were not tried".
std::string refused_text(std::size_t count, const EngineWording& engine);

/// Prints a table of measured fixes to stdout. Fixes that were not tried are left out. @param rows the largest number
/// of rows @param engine engine whose parameters are named too
void print_fixes(const FixTable& table, std::size_t rows, const EngineWording& engine = {});

}  // namespace si
