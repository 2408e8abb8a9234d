// A sweep's results as the frontier panel shows them.
#pragma once

#include <nlohmann/json.hpp>

#include "ui/state/measured.h"

namespace si {

/// The columns that may be axes of the plot, in order.
std::vector<MeasuredColumn> measured_columns();

/// A row of results.json, or {"error", "cost", "time"} of other settings.
MeasuredCase measured_case(const nlohmann::ordered_json& row);

/// The noise of a number is that of the row's field named by its column. Rows that failed are left out.
/// @param rows array of results.json @param present as measured_case() takes it; null: nothing
FrontierView frontier_view(const nlohmann::ordered_json& rows, const nlohmann::ordered_json& present,
                           const std::string& cost, const std::string& error);

}  // namespace si
