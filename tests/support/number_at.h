// Numbers of a sweep's rows, as results.json has them.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/report/measure_json.h"

namespace si {

/// The number under a column's key ("error.mae") in a row of results.json; NaN when there is none.
inline double number_at(const nlohmann::ordered_json& row, std::string_view key) {
    const auto dot = key.find('.');
    if (!row.is_object()) return std::numeric_limits<double>::quiet_NaN();
    if (dot == std::string_view::npos) return number_or_nan(row, key);
    const auto field = row.find(key.substr(0, dot));
    return field == row.end() ? std::numeric_limits<double>::quiet_NaN() : number_at(*field, key.substr(dot + 1));
}

}  // namespace si
