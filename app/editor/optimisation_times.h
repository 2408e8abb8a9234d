// Background measurement of the time that each optimisation saves.
#pragma once

#include "app/editor/search.h"
#include "renderer/measure/optimisation_times.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Result of a finished measurement.
struct OptimisationTimesFound {
    SavedTimes times;
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;
    int width = 0, height = 0;
};

/// One measurement of optimisations at a time, on a thread of its own.
class EditorOptimisationTimes : public EditorSearch<OptimisationTimesFound> {
public:
    EditorOptimisationTimes() : EditorSearch("The measurement of optimisations was cancelled") {}
    /// Starts a measurement and cancels the one under way. @param request of the frame that is shown
    void start(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// Writes progress and this scene's results into `shown`, marked as current only if they are about these arguments.
    void fill(EffectsFacts& shown, std::uint64_t scene, const Settings& settings, int width, int height) const;
};

}  // namespace si
