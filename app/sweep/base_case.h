// Base of a sweep's cost multiples: the hard kernel with 1024 texels, timed in the same rounds as the cases.
#pragma once

#include <limits>
#include <optional>

#include "renderer/measure/axes.h"

namespace si {

/// Case number of a sweep's base case (hard kernel, 1024 texels) in the order of a round of timed frames. No case of
/// the plan has this number.
inline constexpr std::size_t kBaseCase = std::numeric_limits<std::size_t>::max();

/// Makes the base case of a sweep: the settings common to all cases, with the hard kernel and a map of 1024 texels.
/// Shadow times of the cases are also given as multiples of its shadow time.
SweepCase base_case(const Settings& common);
/// Returns the number of the sweep's case that draws the same as base_case(), so that the base is not timed separately;
/// nullopt: no case does.
std::optional<std::size_t> base_number(const Settings& common, const SweepPlan& plan);

}  // namespace si
