// A sweep with all that it needs: scene, truth, journal and runner.
#pragma once

#include <filesystem>

#include "app/sweep/rendered_cases.h"

namespace si {

class RunningSweep {
public:
    struct Of {
        CaseSessions sessions;
        SweepSpec spec;
        SweepPlan plan;
        SweepTiming timing;
        bool retry = false;  ///< measure failed cases again
        std::filesystem::path folder;
    };
    /// Opens or begins the folder's journal. @throws Error as Journal does
    RunningSweep(Of of, Renderer& renderer, const Workers& workers = {});
    RunningSweep(const RunningSweep&) = delete;
    RunningSweep& operator=(const RunningSweep&) = delete;

    bool step() { return runner_.step(); }
    const SweepProgress& progress() const { return runner_.progress(); }
    const SweepState& state() const { return journal_.state(); }
    const Of& of() const { return of_; }

private:
    Of of_;
    Measurer measurer_;
    RenderedCases cases_;
    Journal journal_;
    SweepRunner runner_;
};

}  // namespace si
