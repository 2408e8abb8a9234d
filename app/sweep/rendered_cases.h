// Cases of a sweep as the renderer draws and times them, judged by the ray-traced truth.
#pragma once

#include "app/sweep/case_sessions.h"
#include "app/sweep/runner.h"
#include "renderer/measure/measure.h"

namespace si {

/// Width of the pictures that a report shows, in pixels.
inline constexpr int kThumbnailWidth = 320, kArtefactsWidth = 640;

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
