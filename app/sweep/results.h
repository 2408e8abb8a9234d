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
/// clock that timed frames of one kind.
struct RankedRounds {
    std::vector<std::pair<std::string, int>> rounds;  ///< run and round
    bool holds(const Turn& turn) const;
};
/// Of the kind of frames that was timed last, and of several machines the one with most rounds, of equals the last.
RankedRounds ranked_rounds(const SweepState& state);
/// Those that may stand beside times of `run`.
RankedRounds rounds_like(const SweepState& state, const RunInfo& run);

/// The samples of a case over those rounds.
TimeSamples ranked_samples(const CaseState& c, const RankedRounds& rounds);

/// A case that was finished or has failed.
struct SweepRow {
    std::size_t number = 0;                                     ///< in the plan
    std::vector<std::pair<std::string, std::string>> settings;  ///< key and value of what is varied, as drawn
    std::string failed;                                         ///< why it has no numbers; empty: it did not fail
    CaseNumbers numbers;
    std::vector<std::string> notes;
};

struct SweepResults {
    nlohmann::ordered_json spec;  ///< SweepState::spec
    std::size_t combinations = 0, cases = 0, finished = 0, failed = 0;
    std::string renderer, clock;  ///< of the rounds that are ranked
    bool software = false;
    CostCase cost = CostCase::Forced;  ///< of which frames those are
    std::size_t rounds = 0;
    std::vector<std::pair<RunInfo, int>> runs;  ///< each with how many of the rounds are its
    std::string x, y;                           ///< keys of the columns that the plot begins with
    std::vector<std::size_t> frontier, tied;    ///< numbers of cases on these
    std::vector<SweepRow> rows;                 ///< by number
};

SweepResults sweep_results(const SweepState& state, const SweepPlan& plan);

/// Everything as JSON; numbers that are not finite become null when it is written.
nlohmann::ordered_json results_json(const SweepResults& results);

/// One line a case, the header first (RFC 4180 with plain line breaks).
std::string results_csv(const SweepResults& results);

/// Paths of a case's pictures within the sweep's folder.
std::string picture_path(std::size_t case_number);
std::string artefacts_path(std::size_t case_number);

}  // namespace si
