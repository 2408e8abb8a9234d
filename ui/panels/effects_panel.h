// The panel Effects: each effect of the frame, drawn, cached or skipped, with its reason and cost.
#pragma once

#include <optional>
#include <span>

#include "renderer/frame/optimisation_set.h"
#include "ui/panels/tune.h"

namespace si {

struct DriverInfo;
struct FrameResult;
struct FrameTimes;
struct Effect;      // renderer/inspect/effects.h
struct SavedTimes;  // renderer/measure/optimisation_times.h

/// State of the panel. Forcing is no setting, because it changes no picture.
struct EffectsPanel {
    OptimisationSet forced;      ///< optimisations that are switched off
    bool hide_uncalled = false;  ///< lists only what is drawn or cached
};

/// Facts of the panel.
struct EffectsFacts {
    std::span<const Effect> effects;                ///< empty unless requested
    const SavedTimes* saved = nullptr;              ///< last measured times; null: none, or of another scene
    bool saved_current = false;                     ///< these times are of the present settings and size
    std::optional<SearchProgress> measuring_saved;  ///< under way
};

/// Requests of the panel.
struct EffectsRequests {
    bool want_effects = false;         ///< the panel is shown
    bool measure_saved_times = false;  ///< measure the time that each optimisation saves
    bool cancel_saved = false;         ///< cancel that measurement
};

/// Draws the panel Effects: a row an effect with its state, reason and cost, then the frame's sum.
/// @param times of the last frames @param result of the last frame; null: none @param driver null: not known
void draw_effects(EffectsPanel& panel, const FrameTimes& times, const FrameResult* result, const DriverInfo* driver,
                  const EffectsFacts& facts, EffectsRequests& requests);

}  // namespace si
