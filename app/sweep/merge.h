// Shards of a sweep put together.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/sweep/state.h"

namespace si {

/// The sweep of which all parts are shards, or parts of the same work done twice: of a case that several know, the
/// first that did not fail counts, and those that contradict it are named in the notes. @param parts name for messages,
/// and state; at least one. @throws Error when they are not of one sweep, naming two that differ and how.
SweepState merge_sweeps(const std::vector<std::pair<std::string, SweepState>>& parts);

/// Lines of a journal that make `known` know what `more` of the same sweep knows besides.
std::vector<nlohmann::ordered_json> lines_beyond(const SweepState& known, const SweepState& more);

/// Numbers of the plan's cases that nobody has measured.
std::vector<std::size_t> missing_cases(const SweepState& state, const SweepPlan& plan);

}  // namespace si
