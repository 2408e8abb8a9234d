// State of a sweep: the sum of its journal's lines.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/base/json_text.h"
#include "app/sweep/spec.h"
#include "renderer/base/error.h"
#include "renderer/measure/shadow_time.h"
#include "renderer/measure/time_sampler.h"
#include "renderer/reference/metrics.h"

namespace si {

inline constexpr const char* kJournalFormat = "shadow-inspector-sweep-journal";

/// Times of some frames of one case (combination of settings) of a sweep, drawn in one round. A round times every case
/// once, so that drift affects all cases equally.
struct RoundTimes {
    int round = 0;
    std::string run;
    TimeSamples samples;
    ShadowSamples shadow = {};  ///< empty in journals of versions without shadow times
};

/// Error metrics of one case (combination of settings) of a sweep, with the noise of the ray-traced reference.
struct CaseErrors {
    ErrorMetrics metrics;
    double noise = std::numeric_limits<double>::quiet_NaN();  ///< noise of the reference; NaN: unknown
};

/// Error, cost (texels, draws, triangles) and times of one case (combination of settings) of a sweep, as plots and
/// tables show them. Numbers that are not measured yet are empty.
struct CaseNumbers {
    std::optional<CaseErrors> error;
    std::optional<WorkCost> cost;
    std::optional<TimeMeasurement> time;
    std::optional<ShadowTime> shadow = {};
};

/// Error and cost (texels, draws, triangles) of one case (combination of settings) of a sweep. A repeated measurement
/// gives the same numbers, unlike times.
struct CaseErrorAndCost {
    CaseErrors error;
    WorkCost cost;
    std::vector<std::string> notes;
    int map_resolution = 0;  ///< resolution drawn if the driver or the memory limit made it smaller; else 0
    /// Settings as drawn that differ from those of the plan's case: key and value. An engine profile converts its
    /// values for the map of each case, and another scene of a file suggests settings of its own.
    std::vector<std::pair<std::string, std::string>> own_settings;
};

/// Results of one case (combination of settings) of a sweep so far: error, cost (texels, draws, triangles), failures
/// and timed frames.
struct CaseState : CaseErrorAndCost {
    bool finished = false;  ///< error and cost are known
    std::string failed;     ///< why the case failed; empty: it did not
    int begun = 0;          ///< number of attempts that did not end (the program crashed)
    std::vector<RoundTimes> turns;

    /// Returns true if the case of a sweep was measured and did not fail.
    bool is_measured() const { return finished && failed.empty(); }
};

/// Describes the first difference between two measurements of one case of a sweep; empty: they agree, or one of them
/// has failed or is unfinished. Only error and cost count, since times may differ.
std::string contradiction(const CaseState& a, const CaseState& b);

/// Description of a process that measures a sweep: its machine, start, driver, and the clock that times passes. Decides
/// whether times are comparable.
struct RunInfo {
    std::string id, started;  ///< UTC, ISO 8601
    std::string machine;      ///< hash that is equal only on the same machine
    std::string renderer, version, clock;
    bool software = false;             ///< the driver draws on the CPU
    double load = 0;                   ///< load of the machine at the start, running processes per core
    CostCase cost = CostCase::Forced;  ///< kind of frames that the process timed
    /// Returns true if the frame times of this process and of `other` are comparable: same machine, driver, clock and
    /// kind of timed frames (CostCase: camera moves, light moves, or every pass drawn).
    bool comparable_with(const RunInfo& other) const;
};

/// Returns a description of the present process for a sweep's journal, with id, start, machine and load. The caller
/// adds driver, clock and kind of timed frames.
RunInfo this_run();

/// Error for a sweep's journal whose error metrics have another definition (kErrorMeaning) than this program's.
struct OtherMeaning : Error {
    using Error::Error;
};

/// State of a sweep as its journal records it: specification, and measured numbers of all cases so far. sweep_results()
/// computes the results from it.
struct SweepState {
    nlohmann::ordered_json spec;  ///< spec_json()
    std::string plan;             ///< plan_key()
    std::vector<RunInfo> runs;
    std::map<std::size_t, CaseState> cases;   ///< by number in the plan
    std::vector<RoundTimes> base_turns;       ///< times of base_case(), if it is none of the plan's cases
    std::size_t case_count = kMaxSweepCases;  ///< number of cases in the plan; case numbers are below it
    std::vector<std::string> notes;           ///< faults of the journal, which are ignored

    /// Adds the content of one line of a sweep's journal to this state, completely or not at all. @throws OtherMeaning
    /// for a journal with other definitions of the error metrics; std::exception for an unknown or faulty line
    void apply(const nlohmann::ordered_json& line);
    /// Finds a process that measured cases of the sweep, by the id that the journal gives it; null: unknown.
    const RunInfo* run(const std::string& id) const;

private:
    /// Returns the state of the case whose number is in a member of a journal line. @param member name of that JSON
    /// member @throws Error for a number that no case has
    CaseState& case_of(const nlohmann::ordered_json& line, const char* member);
};

/// Makes the first line of a sweep's journal. @param spec specification of the sweep, spec_json() @param plan hash of
/// its cases, plan_key()
nlohmann::ordered_json header_line(const nlohmann::ordered_json& spec, const std::string& plan);
/// Makes the line of a sweep's journal that records that a process begins to measure.
nlohmann::ordered_json run_line(const RunInfo& run);
/// Makes the line of a sweep's journal that records that the measurement of a case begins. A case that begins
/// kMaxBegins times without a result has crashed the program, and counts as failed.
nlohmann::ordered_json begin_line(std::size_t case_number);
/// Makes the line of a sweep's journal that records that the user cancelled the measurement of a case. It then does not
/// count as begun.
nlohmann::ordered_json cancelled_line(std::size_t case_number);
/// Makes the line of a sweep's journal that records error and cost (texels, draws, triangles) of a case.
nlohmann::ordered_json facts_line(std::size_t case_number, const CaseErrorAndCost& facts);
/// Makes the line of a sweep's journal that records that a case has failed. @param why message of the failure
nlohmann::ordered_json failure_line(std::size_t case_number, const std::string& why);
/// Makes the line of a sweep's journal that records the times of some frames of a case.
nlohmann::ordered_json turn_line(std::size_t case_number, const RoundTimes& turn);
/// Makes the line of a sweep's journal that records the times of some frames of the base case (hard kernel, 1024
/// texels). Shadow times of the cases are also given as multiples of its shadow time.
nlohmann::ordered_json base_turn_line(const RoundTimes& turn);

/// Number of crashes after which a case of a sweep counts as failed.
inline constexpr int kMaxBegins = 3;

}  // namespace si
