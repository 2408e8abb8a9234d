// A whole search for the least bias, drawn and measured: for the command line and the editor.
#pragma once

#include <functional>

#include "renderer/advise/tuner.h"

namespace si {

struct TuningJob {
    Settings settings;  ///< truth.* say what it is held against
    int width = 1280, height = 720;
    TuneGoals goals;
};

/// Searches to the end. The bias is that of view.light. @param report hears of every step, on this thread.
/// @throws Cancelled; Error when that light draws no map
Tuner run_tuning(Renderer& renderer, const Scene& scene, const TuningJob& job, const Workers& workers,
                 const std::function<void(const Tuner&)>& report);

/// What the search found, in place of bias, kernel and resolution of `settings`.
void apply_tuning(Settings& settings, const Settings& found);

}  // namespace si
