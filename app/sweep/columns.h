// The numbers of a sweep's cases: what they are called, what they mean, and how a plot shows them.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/sweep/numbers.h"

namespace si {

struct Column {
    std::string key;  ///< "error.mae": group and field of a row of results.json
    std::string label, unit, help;
    std::function<double(const CaseNumbers&)> value;  ///< NaN when there is none
    Better better = Better::Less;                     ///< a plot shows its shortfall()
    std::string noise = {};  ///< key of the field up to which differences are none; empty: exact
    std::function<double(const CaseNumbers&)> noise_value = {};
};

/// The metrics, then times and costs.
std::span<const Column> columns();
const Column* find_column(std::string_view key);
/// Its label; of a time with what the frames were that it is of: "Time of a frame while the camera moves".
std::string label_of(const Column& column, CostCase cost);

/// As the plot shows it; NaN when it is not shown.
double plotted_value(const Column& column, const CaseNumbers& numbers);
/// Up to which its differences are none.
double noise_of(const Column& column, const CaseNumbers& numbers);

}  // namespace si
