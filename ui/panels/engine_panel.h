// State of the group Engine in the settings' column: parameters of another engine.
#pragma once

#include "renderer/profiles/engine_profile.h"

namespace si {

struct EditorState;
struct EditorFrame;

/// Engine that the user has chosen, with the numbers of its parameters.
struct EnginePanel {
    const EngineProfile* profile = nullptr;  ///< null: none
    double angle_deg = 45;                   ///< reference angle of conversions
    EngineValues values;                     ///< as typed, or as the settings give them
    Settings applied;                        ///< settings that `values` stand for
};

/// Draws a combo of engines and the parameters of the chosen one. A changed parameter changes our settings.
void draw_engine_panel(EditorState& state, const EditorFrame& frame);

}  // namespace si
