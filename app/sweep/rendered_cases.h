// Cases of a sweep, drawn and timed by the renderer and compared with the ray-traced reference.
#pragma once

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
    CaseFacts facts(const SweepCase& c) override;
    TimeSamples time(const SweepCase& c, int frames, CostCase cost) override;

private:
    Measurer& measurer_;
    const DriverInfo& driver_;
    CaseSessions& sessions_;
};

}  // namespace si
