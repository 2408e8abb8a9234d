// Base of a sweep's cost multiples: the hard kernel with 1024 texels, timed in the same rounds as the cases.
#pragma once

#include <limits>
#include <optional>

#include "renderer/measure/axes.h"

namespace si {

/// Number that stands for the base in the order of a round.
inline constexpr std::size_t kBaseCase = std::numeric_limits<std::size_t>::max();

/// Makes the base of cost multiples: the settings that all cases share, with the hard kernel and 1024 texels.
SweepCase base_case(const Settings& common);
/// Returns the number of the plan's case that draws the same as the base; nullopt: none does.
std::optional<std::size_t> base_number(const Settings& common, const SweepPlan& plan);

}  // namespace si
