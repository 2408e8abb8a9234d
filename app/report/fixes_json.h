// Table of measured fixes as JSON and as text (docs/cli.md).
#pragma once

#include <string>

#include "app/base/json_text.h"
#include "renderer/advise/fixes.h"

namespace si {

/// Converts changes of settings, key and value, to a JSON object.
nlohmann::ordered_json changes_json(const std::vector<std::pair<std::string, std::string>>& changes);
/// Converts the change of a cost to JSON {difference, noise, told}.
nlohmann::ordered_json change_json(const CostChange& ms);
/// Converts a table of fixes to JSON: one object a row, in the table's order.
nlohmann::ordered_json fixes_json(const FixTable& table);

/// Prints a table of measured fixes to stdout. Fixes that were not tried are left out. @param rows the largest number
/// of rows
void print_fixes(const FixTable& table, std::size_t rows);

}  // namespace si
