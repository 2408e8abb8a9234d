// Columns of sweep results: key, label, unit and plot scale of each number.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/sweep/numbers.h"

namespace si {

/// Number that a sweep records for each case.
struct Column {
    std::string key;  ///< "error.mae": group and field of a row of results.json
    std::string label, unit, help;
    std::function<double(const CaseNumbers&)> value;  ///< NaN if not measured
    Better better = Better::Less;                     ///< direction of improvement; plots show shortfall()
    std::string noise = {};  ///< key of the field that holds the noise; smaller differences are none; empty: exact
    std::function<double(const CaseNumbers&)> noise_value = {};
};

/// Lists all columns: error metrics first, then times and costs.
std::span<const Column> columns();
/// Finds a column by key; null: unknown.
const Column* find_column(std::string_view key);
/// Returns the label of a column. Times name the kind of frames: "Time of a frame while the camera moves".
std::string label_of(const Column& column, CostCase cost);

/// Returns the value of a column as a plot shows it; NaN if it is not shown.
double plotted_value(const Column& column, const CaseNumbers& numbers);
/// Returns the noise of a column's value. Smaller differences mean nothing.
double noise_of(const Column& column, const CaseNumbers& numbers);

}  // namespace si
