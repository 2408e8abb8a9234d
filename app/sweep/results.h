// A sweep's results as tables and files: results.json and results.csv (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/sweep/state.h"

namespace si {

inline constexpr const char* kResultsFormat = "shadow-inspector-sweep";
inline constexpr int kResultsVersion = 1;
/// The preset in the folder with the settings that all cases share.
inline constexpr const char* kBasePreset = "base.json";

/// Which turns count: those of whole rounds (each of its cases drawn in one run), of runs on one machine with one
/// clock.
struct RankedRounds {
    std::vector<std::pair<std::string, int>> rounds;  ///< run and round
    bool holds(const Turn& turn) const;
};
/// Of several machines the one with most rounds, of equals the last.
RankedRounds ranked_rounds(const SweepState& state);
/// Those that may stand beside times of `run`.
RankedRounds rounds_like(const SweepState& state, const RunInfo& run);

/// The samples of a case over those rounds.
TimeSamples ranked_samples(const CaseState& c, const RankedRounds& rounds);

/// Everything as JSON; numbers that are not finite become null when it is written.
nlohmann::ordered_json results_json(const SweepState& state, const SweepPlan& plan);

/// One line a case, the header first (RFC 4180 with plain line breaks).
std::string results_csv(const nlohmann::ordered_json& results);

/// Paths of a case's pictures within the sweep's folder.
std::string picture_path(std::size_t case_number);
std::string artefacts_path(std::size_t case_number);

}  // namespace si
