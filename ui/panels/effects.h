// What the frame simulates and what it spares: what the panel is set to, shows and wishes for.
#pragma once

#include <optional>
#include <span>

#include "renderer/frame/savings.h"
#include "ui/panels/tune.h"

namespace si {

struct Effect;      // renderer/frame/effects.h
struct SavedTimes;  // renderer/measure/saved.h

/// A person's tool, no part of the settings: forcing changes no picture.
struct EffectsPanel {
    OptimisationSet forced;      ///< savings that frames are not to make
    bool hide_uncalled = false;  ///< list only what is simulated or kept
};

struct EffectsShown {
    std::span<const Effect> effects;           ///< empty unless asked for
    const SavedTimes* saved = nullptr;         ///< that were measured last; null: none, or of another scene
    bool saved_current = false;                ///< they are of the present settings and picture
    std::optional<TuneFacts> measuring_saved;  ///< under way
};

struct EffectsActions {
    bool want_effects = false;  ///< the panel is shown
    bool measure_saved = false, cancel_saved = false;
};

}  // namespace si
