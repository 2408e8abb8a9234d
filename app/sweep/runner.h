// Runner of a sweep, step by step: first error and cost of each case, then rounds of timed frames over all cases.
#pragma once

#include <chrono>

#include "app/sweep/base_case.h"
#include "app/sweep/journal.h"

namespace si {

/// Error, cost (texels, draws, triangles) and encoded pictures of one case (combination of settings) of a sweep, after
/// it was drawn.
struct DrawnCase : CaseErrorAndCost {
    std::string picture_jpg, artefacts_png;  ///< the files' bytes
};

/// Times of frames and of shadows of one case (combination of settings) of a sweep, measured in one round.
struct CaseTimes {
    TimeSamples frames;
    ShadowSamples shadow = {};
};

/// Smallest number of pairs of frames, with and without shadows, that one of the first rounds draws: the noise of a
/// single pair is unknown. Later rounds may draw one, since the noise comes from the differences between rounds.
inline constexpr int kLeastFrames = 2;

/// Interface through which a sweep measures its cases. The program draws them (RenderedCases); tests use fakes.
class CaseMeter {
public:
    virtual ~CaseMeter() = default;
    /// Describes the process that measures the cases of a sweep: machine, driver, and the clock that times passes.
    virtual RunInfo run() = 0;
    /// Draws one case of a sweep and measures its error and cost (texels, draws, triangles). @throws std::exception:
    /// the case has failed
    virtual DrawnCase facts(const SweepCase& c) = 0;
    /// Measures the times of one case of a sweep after warm-up frames: of `frames` frames, and of the shadows alone by
    /// as many pairs of frames with and without shadows.
    /// @param cost kind of frames to time @param which kinds of frames to draw for the times of the shadows alone
    /// @throws std::exception: the case has failed
    virtual CaseTimes time(const SweepCase& c, int frames, CostCase cost, ShadowFrames which) = 0;
};

/// Progress of a sweep: its phase, the steps done, and the estimated seconds left.
struct SweepProgress {
    bool timing = false;              ///< phase: timed rounds; false: errors and costs
    std::size_t done = 0, total = 0;  ///< steps of this phase
    int round = 0;
    std::string current;      ///< case of the last step
    double seconds_left = 0;  ///< estimate for all phases; 0: unknown
};

/// Runner that measures a sweep in steps and appends each result to the sweep's journal.
class SweepRunner {
public:
    /// Prepares the steps of a sweep: cases without results or pictures, then rounds of timed frames.
    /// @param retry_failed true: failed cases are measured again @param folder folder of the journal and the pictures
    SweepRunner(const SweepPlan& plan, Shard shard, SweepTiming timing, bool retry_failed, CaseMeter& meter,
                Journal& journal, std::filesystem::path folder);
    /// Runs the next step of the sweep: measures error and cost of one case, or times some frames of one case. Returns
    /// false when the sweep is done.
    bool step();
    /// Returns the progress of the sweep.
    const SweepProgress& progress() const { return progress_; }

private:
    using Clock = std::chrono::steady_clock;
    /// Draws the next case of the sweep, and records its error, its cost (texels, draws, triangles) and its pictures.
    /// Returns false if no case is left.
    bool step_facts();
    /// Times some frames of the next case in the present round of the sweep. Returns false if all times are precise
    /// enough, or after the last round.
    bool step_timing();
    /// Begins a round in which every measured case of the sweep is timed once. The order of the cases is reversed from
    /// round to round, so that drift affects early and late cases equally.
    void begin_round();
    /// Returns the description of this process for the sweep's journal: machine, driver, clock that times passes, kind
    /// of timed frames.
    RunInfo this_run() const;
    /// Returns the kinds of frames that the present round draws. Pairs of frames under a still light and with all
    /// optimisations off are drawn in the first rounds only: the frontier (error over cost) ranks by the moving light.
    ShadowFrames times_of_round() const;
    /// Writes the description of this process (machine, driver, clock that times passes) to the sweep's journal, unless
    /// it is there already. Called before each result.
    void record_run();
    /// Updates the estimated seconds until the sweep ends, from the durations of its steps so far.
    void estimate();

    const SweepPlan& plan_;
    SweepTiming timing_;
    CaseMeter& meter_;
    Journal& journal_;
    std::filesystem::path folder_;
    std::vector<std::size_t> todo_;   ///< cases whose facts or pictures are missing, in order
    std::size_t next_ = 0;            ///< index into todo_
    SweepCase base_;                  ///< base_case()
    bool times_base_ = false;         ///< the base is none of the cases, so that it has a turn of its own
    std::vector<std::size_t> order_;  ///< order of the cases in the present round; kBaseCase: the base
    std::size_t turn_ = 0;            ///< index into order_
    int round_ = -1;
    std::string run_;
    SweepProgress progress_;
    double facts_s_ = 0, turns_s_ = 0;  ///< seconds spent so far
    std::size_t turns_ = 0;
};

}  // namespace si
