// Merging of the shards of a sweep.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/sweep/state.h"

namespace si {

/// Merges shards of one sweep, or repeated runs of it. For a case in several parts the first result that did not fail
/// counts; contradicting ones are named in the notes. @param parts name for messages, and state; at least one
/// @throws Error when the parts belong to different sweeps, naming two and their difference
SweepState merge_sweeps(const std::vector<std::pair<std::string, SweepState>>& parts);

/// Returns the journal lines of `more` that `known` lacks. Both are states of one sweep.
std::vector<nlohmann::ordered_json> missing_lines(const SweepState& known, const SweepState& more);

/// Returns the numbers of the plan's cases without a result, to be measured still. A failed case counts as one with a
/// result.
std::vector<std::size_t> missing_cases(const SweepState& state, const SweepPlan& plan);

}  // namespace si
