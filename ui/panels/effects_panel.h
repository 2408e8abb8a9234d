// The panel Effects: each effect of the frame, drawn, cached or skipped, with its reason and cost.
#pragma once

#include <optional>
#include <span>

#include "renderer/frame/optimisation_set.h"
#include "ui/panels/tune_controls.h"

namespace si {

struct DriverInfo;
struct FrameResult;
struct FrameTimes;
struct Effect;
struct SavedTimes;

/// State of the panel Effects, with the optimisations that the user has switched off. A preset does not save them,
/// since they do not change the picture.
struct EffectsPanel {
    OptimisationSet forced;   ///< optimisations that are switched off
    bool all_listed = false;  ///< also lists effects that nothing needs
};

/// Data that the panel Effects shows: the effects (passes of the frame and their parts), and the time that each
/// optimisation saves.
struct EffectsFacts {
    std::span<const Effect> effects;                        ///< empty unless requested
    const SavedTimes* saved = nullptr;                      ///< last measured times; null: none, or of another scene
    bool saved_times_current = false;                       ///< `saved` belongs to the present settings and size
    std::optional<SearchProgress> measuring_optimisations;  ///< progress; none: nothing is being measured
};

/// Requests of the panel Effects to the application: list the effects of a frame (its passes and their parts), and
/// measure the time that optimisations save.
struct EffectsRequests {
    bool want_effects = false;         ///< the panel is shown
    bool measure_saved_times = false;  ///< measure the time that each optimisation saves
    bool cancel_measuring = false;     ///< cancel that measurement
};

/// Draws the panel Effects: the summed cost of the frame (time, draws, triangles), then a row for each effect. An
/// effect is a pass or a part of one; its row has state, reason and cost.
/// @param times times of the last frames @param result the last frame; null: none @param driver the driver; null: not
/// known
void draw_effects(EffectsPanel& panel, const FrameTimes& times, const FrameResult* result, const DriverInfo* driver,
                  const EffectsFacts& facts, EffectsRequests& requests);

}  // namespace si
