// Search for the least bias without acne, for the command line and the editor.
#pragma once

#include <functional>

#include "renderer/advise/tuner.h"

namespace si {

/// Inputs of a search for the least bias besides the scene: settings, picture size, goals.
struct TuningJob {
    Settings settings;  ///< truth.* choose the reference
    int width = 1280, height = 720;
    TuneGoals goals;
};

/// Searches the least bias of the light `view.light` and returns the finished search. @param report called after every
/// step, on this thread @throws Cancelled; Error when that light draws no map
Tuner run_tuning(Renderer& renderer, const Scene& scene, const TuningJob& job, const Workers& workers,
                 const std::function<void(const Tuner&)>& report);

/// Replaces bias, kernel and resolution of `settings` by those that a bias search found.
void apply_tuning(Settings& settings, const Settings& found);

}  // namespace si
