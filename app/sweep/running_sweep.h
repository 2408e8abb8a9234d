// Running sweep with its scene, reference, journal and runner.
#pragma once

#include <filesystem>

#include "app/sweep/rendered_cases.h"

namespace si {

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
    RunningSweep(const RunningSweep&) = delete;
    RunningSweep& operator=(const RunningSweep&) = delete;

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
