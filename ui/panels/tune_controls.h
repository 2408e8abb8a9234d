// The button that finds the least bias, its limits, and how far a search is.
#pragma once

#include "ui/state/editor_ui.h"

namespace si {

void draw_tune_controls(EditorState& state, const EditorFrame& frame, EditorActions& actions);

}  // namespace si
