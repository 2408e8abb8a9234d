// State of the group Engine in the tab Settings: parameters of another engine.
#pragma once

#include "renderer/profiles/engine_wording.h"

namespace si {

struct FrameResult;

/// State of the group Engine in the tab Settings, where the user edits settings as the parameters of another engine:
/// the chosen engine and the values of its parameters.
struct EnginePanel {
    const EngineProfile* profile = nullptr;  ///< null: none
    double angle_deg = 45;                   ///< reference angle of conversions
    EngineValues values;                     ///< as typed, or as the settings give them
    Settings applied;                        ///< settings that `values` stand for
    MapFacts facts;                          ///< map for which `values` stand for `applied`
    bool gives_bias = false;                 ///< the bias of `applied` was converted from `values`
    int rounds = 0;                          ///< conversions for another map since other settings changed last
};

/// Returns the translator of setting changes into parameters of the chosen engine, for the shown light's map. Its texts
/// are empty if no engine is chosen.
/// @param result frame that gives size and depth range of the map; null: the settings give them
EngineWording engine_wording(const EnginePanel& panel, const Settings& settings, const FrameResult* result);

/// Draws a combo of other engines and the parameters of the chosen one. When the user edits a parameter, the settings
/// change to match it.
/// @param result frame that gives size and depth range of the map; null: the settings give them
void draw_engine_panel(EnginePanel& panel, Settings& settings, const FrameResult* result);

}  // namespace si
