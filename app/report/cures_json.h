// The cure table as JSON and as text (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "renderer/measure/cures.h"

namespace si {

/// One object a row, in the table's order.
nlohmann::ordered_json fixes_json(const FixTable& table);

/// @param rows at most so many; what was not tried is left out
void print_fixes(const FixTable& table, std::size_t rows);

}  // namespace si
