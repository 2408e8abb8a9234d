// What the frame simulates and what it spares: what the panel is set to, shows and wishes for.
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

/// A person's tool, no part of the settings: forcing changes no picture.
struct EffectsPanel {
    OptimisationSet forced;      ///< savings that frames are not to make
    bool hide_uncalled = false;  ///< list only what is simulated or kept
};

struct EffectsFacts {
    std::span<const Effect> effects;                ///< empty unless asked for
    const SavedTimes* saved = nullptr;              ///< that were measured last; null: none, or of another scene
    bool saved_current = false;                     ///< they are of the present settings and picture
    std::optional<SearchProgress> measuring_saved;  ///< under way
};

struct EffectsRequests {
    bool want_effects = false;  ///< the panel is shown
    bool measure_saved = false, cancel_saved = false;
};

/// Draws the panel Effects: a row an effect with its state, reason and cost, then the frame's sum.
/// @param times of the last frames @param result of the last frame; null: none @param driver null: not known
void draw_effects(EffectsPanel& panel, const FrameTimes& times, const FrameResult* result, const DriverInfo* driver,
                  const EffectsFacts& facts, EffectsRequests& requests);

}  // namespace si
