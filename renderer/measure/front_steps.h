// Features of the Pareto front: its steps, its knee, and the best case within a multiple of the base's cost.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/measure/frontier.h"

namespace si {

/// Returns the indices of the points on the strict Pareto front of error and cost, by rising cost. Each has a smaller
/// error than all cheaper points; noise is ignored. Points with a value that is not finite are left out.
std::vector<std::size_t> strict_front(std::span<const Dot> dots);

/// Step along the Pareto front of error and cost, from one case to the next more expensive case.
struct FrontStep {
    std::size_t from = 0, to = 0;  ///< indices of points
    double cost_factor = 1;        ///< cost of `to` / cost of `from`; infinite if `from` costs 0
    double error_reduction = 0;    ///< 1 - error of `to` / error of `from`, 0..1
};
/// Computes the ratio of cost and the relative reduction of error between consecutive cases of a Pareto front.
/// @param front indices of the cases by rising cost, as from strict_front()
std::vector<FrontStep> front_steps(std::span<const Dot> dots, std::span<const std::size_t> front);

/// Cost limit in the definition of the knee of a Pareto front (knee_of()), as a multiple of the knee's cost. Up to this
/// limit, no case has an error lower by kKneeReduction.
inline constexpr double kKneeCost = 2;
/// Relative reduction of the error by which one case is clearly better than another, when the knee of a Pareto front is
/// searched (knee_of()).
inline constexpr double kKneeReduction = 0.25;

/// Returns true when the error of case `dot` is lower than that of case `at` by at least kKneeReduction, relative to
/// `at`. Used to find the knee of a Pareto front.
bool is_clearly_better(const Dot& dot, const Dot& at);

/// Finds the knee of a Pareto front of error and cost. It is the cheapest case of the front for which no case at up to
/// kKneeCost times its cost has an error lower by kKneeReduction. The last case of the front is the knee only if a more
/// expensive case was measured.
/// @returns index into `dots`; nullopt when each doubling of the cost still lowers the error by a quarter
std::optional<std::size_t> knee_of(std::span<const Dot> dots, std::span<const std::size_t> front);

/// Cost limits in the table of best cases (BestRow), as multiples of the cost of the base case (hard kernel, 1024
/// texels).
inline constexpr double kCostMultiples[] = {1, 2, 4, 8};

/// Finds the case with the least error among those that cost at most `limit`. Among equal errors it takes the cheapest
/// case. Returns the case's index; nullopt when every case costs more.
std::optional<std::size_t> best_within(std::span<const Dot> dots, double limit);

}  // namespace si
