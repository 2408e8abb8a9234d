// Cases of a sweep as the renderer draws and times them, judged by the ray-traced truth.
#pragma once

#include "app/session.h"
#include "app/sweep/runner.h"
#include "renderer/measure/measure.h"

namespace si {

/// Width of the pictures that a report shows, in pixels.
inline constexpr int kThumbnailWidth = 320, kArtefactsWidth = 640;

class RenderedCases : public CaseMeter {
public:
    RenderedCases(Measurer& measurer, const DriverInfo& driver, Session& session)
        : measurer_(measurer), driver_(driver), session_(session), posed_(session.settings.scene) {}
    RunInfo run() override;
    CaseFacts facts(const SweepCase& c) override;
    TimeSamples time(const SweepCase& c, int frames) override;

private:
    /// The scene at the case's moment, and its settings with impossible values repaired.
    Settings prepared(const SweepCase& c, std::vector<std::string>* notes = nullptr);

    Measurer& measurer_;
    const DriverInfo& driver_;
    Session& session_;
    SceneSettings posed_;  ///< how the scene stands
};

}  // namespace si
