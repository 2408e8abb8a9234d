// Table of measured fixes as JSON and as text (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "renderer/advise/fixes.h"

namespace si {

/// Converts a table of fixes to JSON: one object a row, in the table's order.
nlohmann::ordered_json fixes_json(const FixTable& table);

/// Prints a table of measured fixes to stdout. Fixes that were not tried are left out. @param rows largest number of
/// rows
void print_fixes(const FixTable& table, std::size_t rows);

}  // namespace si
