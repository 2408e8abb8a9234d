// Runs a sweep step by step: first each case's error and cost, then rounds of timed frames over all cases.
#pragma once

#include <chrono>
#include <functional>

#include "app/sweep/journal.h"
#include "app/sweep/timing.h"

namespace si {

/// Error and cost of a case, and what it looks like.
struct CaseFacts {
    CaseErrors error;
    WorkCost cost;
    std::vector<std::string> notes;
    int map_resolution = 0;                  ///< as drawn, where it had to be smaller; else 0
    std::string picture_jpg, artefacts_png;  ///< the files' bytes
};

/// What measures a case. A sweep of the program uses RenderedCases; tests have their own.
class CaseMeter {
public:
    virtual ~CaseMeter() = default;
    virtual RunInfo run() = 0;
    /// @throws std::exception: the case has failed
    virtual CaseFacts facts(const SweepCase& c) = 0;
    /// `frames` frames after what warms up. @throws std::exception: the case has failed
    virtual TimeSamples time(const SweepCase& c, int frames, CostCase cost) = 0;
};

struct SweepProgress {
    bool timing = false;              ///< the rounds; else errors and costs
    std::size_t done = 0, total = 0;  ///< steps of this phase
    int round = 0;
    std::string current;      ///< the case of the last step
    double seconds_left = 0;  ///< estimated for all phases; 0: nothing known
};

class SweepRunner {
public:
    /// @param folder of the pictures; the journal's
    SweepRunner(const SweepPlan& plan, Shard shard, SweepTiming timing, bool retry_failed, CaseMeter& meter,
                Journal& journal, std::filesystem::path folder);
    /// Measures the facts of one case, or draws one case's frames of a round. False: nothing is left to do.
    bool step();
    const SweepProgress& progress() const { return progress_; }

private:
    using Clock = std::chrono::steady_clock;
    bool step_facts();
    bool step_timing();
    void begin_round();
    RunInfo this_run() const;
    void announce_run();
    void estimate();

    const SweepPlan& plan_;
    SweepTiming timing_;
    CaseMeter& meter_;
    Journal& journal_;
    std::filesystem::path folder_;
    std::vector<std::size_t> todo_;   ///< cases whose facts or pictures are missing, in order
    std::size_t next_ = 0;            ///< of todo_
    std::vector<std::size_t> order_;  ///< of the round under way
    std::size_t turn_ = 0;            ///< of order_
    int round_ = -1;
    std::string run_;
    SweepProgress progress_;
    double facts_s_ = 0, turns_s_ = 0;  ///< spent so far
    std::size_t turns_ = 0;
};

}  // namespace si
