// Columns of sweep results: key, label, unit and plot scale of each number.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "app/sweep/state.h"

namespace si {

/// Column of the results of a sweep: a measured number of each case, with label, unit and noise.
struct Column {
    std::string key;  ///< "error.mae": group and field of a row of results.json
    std::string label, unit, help;
    std::function<double(const CaseNumbers&)> value;  ///< NaN if not measured
    Better better = Better::Less;                     ///< direction of improvement; plots show distance_from_best()
    std::string noise = {};  ///< key of the field that holds the noise; smaller differences are none; empty: exact
    std::function<double(const CaseNumbers&)> noise_value = {};
    std::string bound = {};  ///< group of the field `below_noise`; such a value is plotted as its upper bound
    std::function<const Spread*(const CaseNumbers&)> bounded = {};  ///< distribution of the value; null: not measured
};

/// Keys of columns with shadow times: while the light moves, as a multiple of the base case's time (hard kernel, 1024
/// texels), and while only the camera moves.
inline constexpr const char* kMovingShadowColumn = "shadow.moving_ms.median";
inline constexpr const char* kOfBaseColumn = "shadow.of_base";
inline constexpr const char* kStillShadowColumn = "shadow.still_ms.median";

/// Lists all columns that the results of a sweep can have: error metrics first, then times and costs.
std::span<const Column> columns();
/// Finds a column of sweep results by key, such as "error.mae"; null: unknown key.
const Column* find_column(std::string_view key);
/// Returns the label of a column of sweep results for plots and tables. Labels of frame times name the kind of frames:
/// "Time of a frame while the camera moves".
std::string label_of(const Column& column, CostCase cost);

/// Returns the number that plots show for a column of one case of a sweep; less is better. It is the distance of the
/// measured value from the ideal one (0, or 1 where more is better). A time that does not exceed its noise gives its
/// upper bound instead. NaN if the value was not measured, or if no value is ideal (Better::Neither).
double plotted_value(const Column& column, const CaseNumbers& numbers);
/// Returns true when a case's value in a column of sweep results does not differ from 0 by more than its noise. Plots
/// then show its upper bound.
bool is_bound(const Column& column, const CaseNumbers& numbers);
/// Returns the noise of a case's value in a column of sweep results; 0: exact or unknown. Smaller differences between
/// cases have no meaning.
double noise_of(const Column& column, const CaseNumbers& numbers);

}  // namespace si
