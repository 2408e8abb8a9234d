// Running sweep with its scene, reference, journal and runner. The renderer draws, times and compares each case.
#pragma once

#include <filesystem>

#include "app/sweep/case_sessions.h"
#include "app/sweep/runner.h"
#include "renderer/measure/measure.h"

namespace si {

/// Widths of the two pictures of each case in a sweep's report, pixels: the thumbnail, and the frame with wrong pixels
/// in colour.
inline constexpr int kThumbnailWidth = 320, kArtefactsWidth = 640;

/// CaseMeter that measures the cases of a sweep with the program's renderer. It draws each case, compares it with the
/// reference and times its frames.
class RenderedCases : public CaseMeter {
public:
    RenderedCases(Measurer& measurer, const DriverInfo& driver, CaseSessions& sessions)
        : measurer_(measurer), driver_(driver), sessions_(sessions) {}
    RunInfo run() override;
    DrawnCase facts(const SweepCase& c) override;
    CaseTimes time(const SweepCase& c, int frames, CostCase cost, ShadowFrames which) override;

private:
    Measurer& measurer_;
    const DriverInfo& driver_;
    CaseSessions& sessions_;
};

/// Sweep that is measured step by step. It owns the scenes of its cases (combinations of settings), the object that
/// measures them, and the journal of the results.
class RunningSweep {
public:
    /// Inputs of a sweep that is to run: scenes of its cases, specification, plan, timing and folder.
    struct Inputs {
        CaseSessions sessions;
        SweepSpec spec;
        SweepPlan plan;
        SweepTiming timing;
        bool retry = false;  ///< measure failed cases again
        std::filesystem::path folder;
    };
    /// Prepares a sweep: begins the journal in its folder, or opens it to continue an earlier sweep. @throws Error as
    /// Journal::Journal()
    RunningSweep(Inputs inputs, Renderer& renderer, const Workers& workers = {});

    /// Runs the next step of the sweep: measures error and cost of one case, or times some frames of one case. Returns
    /// false when the sweep is done.
    bool step() { return runner_.step(); }
    /// Returns the progress of the sweep.
    const SweepProgress& progress() const { return runner_.progress(); }
    /// Returns the results of the sweep so far, as its journal records them.
    const SweepState& state() const { return journal_.state(); }
    /// Returns the inputs that the sweep was made with.
    const Inputs& inputs() const { return inputs_; }

private:
    Inputs inputs_;
    Measurer measurer_;
    RenderedCases cases_;
    Journal journal_;
    SweepRunner runner_;
};

}  // namespace si
