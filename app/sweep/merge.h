// Merging of the shards of a sweep.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/sweep/state.h"

namespace si {

/// Merges shards of one sweep (parts that several machines measured), or repeated runs of it, into one state. If
/// several parts measured a case, the first result that did not fail counts. Contradicting results are named in the
/// notes.
/// @param parts name for messages, and state; at least one
/// @throws Error when the parts belong to different sweeps, naming two and their difference
SweepState merge_sweeps(const std::vector<std::pair<std::string, SweepState>>& parts);

/// Returns the journal lines for those results of `more` that `known` lacks. Both are states of one sweep. Used to
/// append merged results to a journal.
std::vector<nlohmann::ordered_json> missing_lines(const SweepState& known, const SweepState& more);

/// Returns the numbers of the cases that a sweep has still to measure. A failed case counts as measured.
std::vector<std::size_t> missing_cases(const SweepState& state, const SweepPlan& plan);

}  // namespace si
