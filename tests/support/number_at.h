// Reads numbers from the rows of a sweep's results.json.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/report/measure_json.h"

namespace si {

/// Returns the number of a column in a row of results.json; NaN if the row lacks the column.
/// @param key key of the column, with dots between nested fields: "error.mae"
inline double number_at(const nlohmann::ordered_json& row, std::string_view key) {
    const auto dot = key.find('.');
    if (!row.is_object()) return std::numeric_limits<double>::quiet_NaN();
    if (dot == std::string_view::npos) return number_or_nan(row, key);
    const auto field = row.find(key.substr(0, dot));
    return field == row.end() ? std::numeric_limits<double>::quiet_NaN() : number_at(*field, key.substr(dot + 1));
}

}  // namespace si
