// Readings of the Pareto front: its steps, its knee, and the best case within a multiple of the base's cost.
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

/// Step along the Pareto front of error and cost, from one case to the next dearer one.
struct FrontStep {
    std::size_t from = 0, to = 0;  ///< indices of points
    double cost_factor = 1;        ///< cost of `to` over that of `from`; infinite from a cost of 0
    double error_reduction = 0;    ///< share of the error of `from` that `to` lacks, 0..1
};
/// Computes the factor of cost and the reduction of error between consecutive cases of a Pareto front.
/// @param front indices of the cases by rising cost, as from strict_front()
std::vector<FrontStep> front_steps(std::span<const Dot> dots, std::span<const std::size_t> front);

/// Largest cost, as a multiple of the knee's, up to which no case has an error lower by kKneeReduction.
inline constexpr double kKneeCost = 2;
/// Share of the error by which a case must be better to count against a knee.
inline constexpr double kKneeReduction = 0.25;

/// Returns true when the error of a case is lower than that of the case `at` by kKneeReduction (a share) or more. Used
/// to find the knee of a front.
bool is_clearly_better(const Dot& dot, const Dot& at);

/// Finds the knee of a Pareto front of error and cost. It is the cheapest case of the front for which no case at up to
/// kKneeCost times its cost has an error lower by kKneeReduction. The last case of the front is the knee only if a
/// dearer case was measured.
/// @returns index into `dots`; nullopt when each doubling of the cost still lowers the error by a quarter
std::optional<std::size_t> knee_of(std::span<const Dot> dots, std::span<const std::size_t> front);

/// Multiples of the base's cost in the table of best cases.
inline constexpr double kCostMultiples[] = {1, 2, 4, 8};

/// Finds the case with the least error among those that cost at most `limit`, and the cheapest of equal ones. Returns
/// its index; nullopt when every case costs more.
std::optional<std::size_t> best_within(std::span<const Dot> dots, double limit);

}  // namespace si
