// Background measurement of the time that each optimisation saves.
#pragma once

#include "app/editor/search.h"
#include "renderer/measure/optimisation_times.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Measured time that each optimisation saves, with the scene, settings and size it belongs to.
struct OptimisationTimesFound {
    SavedTimes times;
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;
    int width = 0, height = 0;
};

/// Background measurement of the time that each optimisation saves: one at a time, on a thread of its own.
class EditorOptimisationTimes : public EditorSearch<OptimisationTimesFound> {
public:
    EditorOptimisationTimes() : EditorSearch("The measurement of optimisations was cancelled") {}
    /// Starts to measure the time that each optimisation saves, and cancels the measurement under way.
    /// @param request frame request of the shown frame
    void start(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// Writes progress and saved times of this scene into `shown`. They are marked as current only if they belong to
    /// these settings and this size. @param scene Scene::id @param width, height pixels
    void fill(EffectsFacts& shown, std::uint64_t scene, const Settings& settings, int width, int height) const;
};

}  // namespace si
