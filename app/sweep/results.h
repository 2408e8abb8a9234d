// Results of a sweep as tables and files: results.json and results.csv (docs/cli.md).
#pragma once

#include <set>
#include <string>

#include "app/base/json_text.h"
#include "app/sweep/state.h"

namespace si {

inline constexpr const char* kResultsFormat = "shadow-inspector-sweep";
inline constexpr int kResultsVersion = 1;
/// Name of the preset in the folder with the settings that all cases share.
inline constexpr const char* kBasePreset = "base.json";

/// Rounds of timed frames whose times are comparable: complete rounds (each case was drawn), by runs on one machine
/// with one clock and one kind of frames.
using RankedRounds = std::set<std::pair<std::string, int>>;  ///< run and round
/// Selects the rounds of timed frames by which the cases of a sweep are ranked. Only the kind of frames (CostCase) of
/// the latest run with a complete round counts. Of the machines that timed this kind, the one with the most complete
/// rounds counts; the latest one if several have equally many.
RankedRounds ranked_rounds(const SweepState& state);
/// Selects the complete rounds of timed frames by runs with the machine, driver, clock and kind of frames of `run`.
RankedRounds rounds_like(const SweepState& state, const RunInfo& run);

/// Collects the time samples of one case in rounds whose times are comparable (see ranked_rounds()).
TimeSamples ranked_samples(const CaseState& c, const RankedRounds& rounds);

/// Collects the shadow times of turns in rounds whose times are comparable.
ShadowSamples ranked_shadow(const std::vector<Turn>& turns, const RankedRounds& rounds);

/// Result of a case that was finished or has failed.
struct SweepRow {
    std::size_t number = 0;                                     ///< number of the case in the plan
    std::vector<std::pair<std::string, std::string>> settings;  ///< varied settings: key and value, as drawn
    std::vector<std::pair<std::string, std::string>> starts;    ///< SweepCase::starts
    std::string failed;  ///< reason why the case has no numbers; empty: it has numbers
    CaseNumbers numbers;
    std::vector<std::string> notes;
};

/// Results of a sweep: counts, the ranked rounds, the Pareto front and one row per case.
struct SweepResults {
    nlohmann::ordered_json spec;  ///< SweepState::spec
    std::size_t combinations = 0, cases = 0, finished = 0, failed = 0;
    std::string renderer, clock;  ///< driver and clock of the ranked rounds
    bool software = false;
    CostCase cost = CostCase::Forced;  ///< kind of frames in the ranked rounds
    std::size_t rounds = 0;
    std::vector<std::pair<RunInfo, int>> runs;  ///< each run with the number of its ranked rounds
    std::string x, y;                           ///< keys of the columns that the plot begins with
    std::optional<ShadowTime> base;             ///< shadow time of base_case()
    std::optional<std::size_t> base_case;       ///< the plan's case that draws the same; nullopt: none
    std::vector<std::size_t> frontier, tied;    ///< numbers of cases on the Pareto front, and tied with it
    std::vector<SweepRow> rows;                 ///< by number
};

/// Computes the results of a sweep from its state.
SweepResults sweep_results(const SweepState& state, const SweepPlan& plan);

/// Converts results to JSON (results.json). Numbers that are not finite become null when it is written.
nlohmann::ordered_json results_json(const SweepResults& results);

/// Converts the time of the shadows to JSON {moving_ms, still_ms, forced_ms, of_base}; a ratio within the noise is
/// null.
nlohmann::ordered_json shadow_json(const ShadowTime& time);

/// Formats results as CSV: a header and one line per case (RFC 4180 with plain line breaks).
std::string results_csv(const SweepResults& results);

/// Returns the path of a case's picture within the sweep's folder.
std::string picture_path(std::size_t case_number);
/// Returns the path of a case's artefact picture within the sweep's folder.
std::string artefacts_path(std::size_t case_number);

}  // namespace si
