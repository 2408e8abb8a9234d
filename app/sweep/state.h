// What is known of a sweep so far: the sum of its journal's lines.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/sweep/numbers.h"
#include "app/sweep/spec.h"
#include "renderer/base/error.h"

namespace si {

inline constexpr const char* kJournalFormat = "shadow-inspector-sweep-journal";

/// A few frames of one case. A round draws every case once, so that drift falls on all alike.
struct Turn {
    int round = 0;
    std::string run;
    TimeSamples samples;
};

struct CaseState {
    bool finished = false;  ///< error and cost are known
    std::string failed;     ///< why there are none; empty: it did not fail
    int begun = 0;          ///< how often it was begun without an end
    CaseErrors error;
    WorkCost cost;
    std::vector<std::string> notes;
    int map_resolution = 0;  ///< as drawn, where the driver or the memory limit made it smaller; else 0
    std::vector<Turn> turns;
};

/// Measured, and not in vain.
bool good(const CaseState& c);

/// How two measurements of one case contradict each other, as a phrase; empty: they do not. Their times may differ.
std::string contradiction(const CaseState& a, const CaseState& b);

/// A process that measured: where, when, with what.
struct RunInfo {
    std::string id, started;  ///< UTC, ISO 8601
    std::string machine;      ///< equal on the same machine only; says nothing else
    std::string renderer, version, clock;
    bool software = false;                             ///< a CPU rasteriser
    double load = 0;                                   ///< of the machine before it began, running processes per core
    CostCase cost = CostCase::Forced;                  ///< of which frames it took times
    bool comparable_with(const RunInfo& other) const;  ///< their times may stand beside each other
};

/// Fills id, started, machine and load.
RunInfo this_run();

/// Errors that mean something else: they cannot stand beside those that are measured now.
struct OtherMeaning : Error {
    using Error::Error;
};

struct SweepState {
    nlohmann::ordered_json spec;  ///< spec_json()
    std::string plan;             ///< plan_key()
    std::vector<RunInfo> runs;
    std::map<std::size_t, CaseState> cases;   ///< by number in the plan
    std::size_t case_count = kMaxSweepCases;  ///< of the plan, where it is known: numbers are below
    std::vector<std::string> notes;           ///< what is wrong with the journal and does not count

    /// Adds what a line of the journal says, all of it or nothing. @throws OtherMeaning (kErrorMeaning), and
    /// std::exception when it says nothing known
    void apply(const nlohmann::ordered_json& line);
    const RunInfo* run(const std::string& id) const;

private:
    /// The case whose number is that member of the line. @throws Error when there is no such case
    CaseState& case_of(const nlohmann::ordered_json& line, const char* member);
};

// Lines of the journal.
nlohmann::ordered_json header_line(const nlohmann::ordered_json& spec, const std::string& plan);
nlohmann::ordered_json run_line(const RunInfo& run);
nlohmann::ordered_json begin_line(std::size_t case_number);
nlohmann::ordered_json facts_line(std::size_t case_number, const CaseState& facts);
nlohmann::ordered_json failure_line(std::size_t case_number, const std::string& why);
nlohmann::ordered_json turn_line(std::size_t case_number, const Turn& turn);

/// A case that the program did not survive this often has failed.
inline constexpr int kMostBegins = 3;

}  // namespace si
