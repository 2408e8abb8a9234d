// Running sweep with its scene, reference, journal and runner. The renderer draws, times and compares each case.
#pragma once

#include <filesystem>

#include "app/sweep/case_sessions.h"
#include "app/sweep/runner.h"
#include "renderer/measure/measure.h"

namespace si {

/// Widths of a report's pictures in pixels: of the scene, and of the artefacts.
inline constexpr int kThumbnailWidth = 320, kArtefactsWidth = 640;

/// Meter that draws, times and compares each case with the program's renderer.
class RenderedCases : public CaseMeter {
public:
    RenderedCases(Measurer& measurer, const DriverInfo& driver, CaseSessions& sessions)
        : measurer_(measurer), driver_(driver), sessions_(sessions) {}
    RunInfo run() override;
    DrawnCase facts(const SweepCase& c) override;
    CaseTimes time(const SweepCase& c, int frames, CostCase cost) override;

private:
    Measurer& measurer_;
    const DriverInfo& driver_;
    CaseSessions& sessions_;
};

/// Sweep that runs in steps: owns sessions, measurer, journal and runner.
class RunningSweep {
public:
    /// Inputs of a running sweep: sessions of its cases, specification, plan, timing and folder.
    struct Inputs {
        CaseSessions sessions;
        SweepSpec spec;
        SweepPlan plan;
        SweepTiming timing;
        bool retry = false;  ///< measure failed cases again
        std::filesystem::path folder;
    };
    /// Opens or begins the journal of the folder. @throws Error as Journal::Journal()
    RunningSweep(Inputs inputs, Renderer& renderer, const Workers& workers = {});

    /// Runs the next step of the sweep (see SweepRunner::step). @returns false when the sweep is done
    bool step() { return runner_.step(); }
    /// Returns the progress of the sweep.
    const SweepProgress& progress() const { return runner_.progress(); }
    /// Returns all results so far.
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
