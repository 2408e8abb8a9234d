// The cure table as JSON and as text (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "renderer/advise/fixes.h"

namespace si {

/// One object a row, in the table's order.
nlohmann::ordered_json cures_json(const CureTable& table);

/// @param rows at most so many; what was not tried is left out
void print_cures(const CureTable& table, std::size_t rows);

}  // namespace si
