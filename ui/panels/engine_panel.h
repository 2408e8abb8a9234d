// State of the group Engine in the tab Settings: parameters of another engine.
#pragma once

#include "renderer/profiles/engine_wording.h"

namespace si {

struct FrameResult;

/// Engine that the user has chosen, with the numbers of its parameters.
struct EnginePanel {
    const EngineProfile* profile = nullptr;  ///< null: none
    double angle_deg = 45;                   ///< reference angle of conversions
    EngineValues values;                     ///< as typed, or as the settings give them
    Settings applied;                        ///< settings that `values` stand for
};

/// Returns the wording of the chosen engine, for the shown light's map; without a profile: none.
EngineWording engine_wording(const EnginePanel& panel, const Settings& settings, const FrameResult* result);

/// Draws a combo of engines and the parameters of the chosen one. A changed parameter changes our settings.
/// @param result frame whose maps the numbers hold for; null: the maps that the settings give
void draw_engine_panel(EnginePanel& panel, Settings& settings, const FrameResult* result);

}  // namespace si
