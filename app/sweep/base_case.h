// Base of a sweep's cost multiples: the hard kernel with 1024 texels, timed in the same rounds as the cases.
#pragma once

#include <limits>
#include <optional>

#include "renderer/measure/axes.h"

namespace si {

/// Case number of the base case (base_case()) in the order of a round; no case of the plan has this number.
inline constexpr std::size_t kBaseCase = std::numeric_limits<std::size_t>::max();

/// Makes the base case of a sweep, whose shadow time is the unit for multiples of costs. It has the settings common to
/// all cases, the hard kernel and a map of 1024 texels.
SweepCase base_case(const Settings& common);
/// Returns the number of the sweep's case that draws the same as base_case(), so that the base is not timed separately;
/// nullopt: no case does.
std::optional<std::size_t> base_number(const Settings& common, const SweepPlan& plan);

}  // namespace si
