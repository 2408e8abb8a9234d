// Results of a sweep as tables and files: results.json and results.csv (docs/cli.md).
#pragma once

#include <map>
#include <set>
#include <string>

#include "app/base/json_text.h"
#include "app/sweep/state.h"

namespace si {

inline constexpr const char* kResultsFormat = "shadow-inspector-sweep";
inline constexpr int kResultsVersion = 1;
/// File name of the preset, in a sweep's folder, with the settings that all cases share.
inline constexpr const char* kBasePreset = "base.json";

/// Rounds of timed frames of a sweep whose times are comparable. In each round every measured case was timed. All
/// rounds have the same machine, driver, clock and kind of frames (redrawn, moving camera or moving light).
using RankedRounds = std::set<std::pair<std::string, int>>;  ///< run and round
/// Selects the rounds of timed frames by which the cases of a sweep are compared. Only complete rounds with the same
/// machine, driver, clock and kind of frames (redrawn, moving camera or moving light) count. The kind is that of the
/// latest run with a complete round. Of several machines, the one with the most complete rounds is chosen; if equally
/// many, the latest.
RankedRounds ranked_rounds(const SweepState& state);
/// Selects the complete rounds of timed frames in a sweep that are comparable with a process: same machine, driver,
/// clock and kind of frames. @param run description of the process
RankedRounds rounds_like(const SweepState& state, const RunInfo& run);

/// Collects the frame times of one case of a sweep from the rounds by which cases are compared (ranked_rounds()).
TimeSamples ranked_samples(const CaseState& c, const RankedRounds& rounds);

/// Slowness of the machine in each round of a sweep: shadow times of the round over their medians of all rounds.
/// 1.2: the round took a fifth longer than usual.
using RoundSlowness = std::map<RankedRounds::value_type, double>;
/// Computes how slow the machine was in each round. A round's number is the median over cases: of a case, its time of
/// the shadow under a moving light in this round, divided by the median of this time over all rounds. Only cases count
/// whose time is positive in every round.
/// @param rounds result of ranked_rounds() @return empty with fewer than eight such cases or three rounds, since one
/// case would decide too much of the median
RoundSlowness round_slowness(const SweepState& state, const RankedRounds& rounds);

/// Collects the shadow times of one case of a sweep, only from the rounds by which cases are compared. Divides each
/// time by the slowness of its round, so that times of different cases compare although the machine's speed changed.
/// @param turns timed frames of the case, by round @param rounds result of ranked_rounds()
/// @param slowness result of round_slowness()
ShadowSamples ranked_shadow(const std::vector<RoundTimes>& turns, const RankedRounds& rounds,
                            const RoundSlowness& slowness);

/// Result of one case (combination of settings) of a sweep, measured or failed: settings, numbers and notes.
struct SweepRow {
    std::size_t number = 0;                                     ///< number of the case in the plan
    std::vector<std::pair<std::string, std::string>> settings;  ///< varied settings: key and value, as drawn
    std::vector<std::pair<std::string, std::string>> starts;    ///< SweepCase::starts
    std::string failed;  ///< reason why the case has no numbers; empty: it has numbers
    CaseNumbers numbers;
    std::vector<std::string> notes;
    std::vector<std::pair<std::string, std::string>> own_settings;  ///< CaseErrorAndCost::own_settings
};

/// Results of a sweep for files and plots: counts of cases and of comparable timing rounds, the Pareto front, and one
/// row per case.
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
    std::optional<std::size_t> base_case;       ///< the plan's case that draws the same as base_case(); nullopt: none
    std::vector<std::size_t> frontier, tied;    ///< numbers of cases on the Pareto front, and tied with it
    std::vector<SweepRow> rows;                 ///< by number
};

/// Computes the results of a sweep (summaries of times, Pareto front) from the state that its journal records.
SweepResults sweep_results(const SweepState& state, const SweepPlan& plan);

/// Converts the results of a sweep to the JSON of results.json. Numbers that are not finite become null when the JSON
/// is written.
nlohmann::ordered_json results_json(const SweepResults& results);

/// Converts the time of the shadows alone to JSON {moving_ms, still_ms, forced_ms, of_base}. `of_base`, the multiple of
/// the base case's time (hard kernel, 1024 texels), is null within the noise.
nlohmann::ordered_json shadow_json(const ShadowTime& time);

/// Formats the results of a sweep as CSV: a header and one line per case (RFC 4180, but with LF line ends).
std::string results_csv(const SweepResults& results);

/// Returns the path of the picture of a sweep's case, relative to the sweep's folder.
std::string picture_path(std::size_t case_number);
/// Returns the path of the picture of a sweep's case in which wrong pixels are coloured, relative to the sweep's
/// folder.
std::string artefacts_path(std::size_t case_number);

}  // namespace si
