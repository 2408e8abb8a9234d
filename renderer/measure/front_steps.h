// Readings of the Pareto front: its steps, its knee, and the best case within a multiple of the base's cost.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/measure/frontier.h"

namespace si {

/// Returns the indices of the strict Pareto front by rising cost. Errors fall strictly; noise is ignored. Points with a
/// value that is not finite are left out.
std::vector<std::size_t> strict_front(std::span<const Dot> dots);

/// Step of the front from one case to the next dearer one.
struct FrontStep {
    std::size_t from = 0, to = 0;  ///< indices of points
    double cost_factor = 1;        ///< cost of `to` over that of `from`; infinite from a cost of 0
    double error_reduction = 0;    ///< share of the error of `from` that `to` lacks, 0..1
};
/// Computes the steps between consecutive cases of a front. @param front as strict_front() returns
std::vector<FrontStep> front_steps(std::span<const Dot> dots, std::span<const std::size_t> front);

/// Largest cost, as a multiple of the knee's, up to which no case has an error lower by kKneeReduction.
inline constexpr double kKneeCost = 2;
/// Share of the error by which a case must be better to count against a knee.
inline constexpr double kKneeReduction = 0.25;

/// Returns true when a case's error is lower than that of `at` by kKneeReduction or more.
bool is_clearly_better(const Dot& dot, const Dot& at);

/// Finds the knee of a front: its cheapest case such that no case costing at most kKneeCost times as much has an error
/// lower by kKneeReduction or more. The last case of the front is the knee only if a dearer case was measured.
/// @returns index of a point; nullopt: each doubling still buys a quarter
std::optional<std::size_t> knee_of(std::span<const Dot> dots, std::span<const std::size_t> front);

/// Multiples of the base's cost in the table of best cases.
inline constexpr double kCostMultiples[] = {1, 2, 4, 8};

/// Finds the point with the least error among those whose cost is at most `limit`, the cheapest of equal ones. nullopt:
/// none costs so little.
std::optional<std::size_t> best_within(std::span<const Dot> dots, double limit);

}  // namespace si
