// What would put wrong pixels right, as a table whose rows are applied by a click.
#pragma once

#include "ui/editor_ui.h"

namespace si {

/// The button that searches (or the search's progress), and what was found. @param pixel the table is wanted for this one,
/// none: for the picture @param wrong there is something to cure
void draw_cures(EditorState& state, const EditorFrame& frame, EditorActions& actions, std::optional<glm::ivec2> pixel,
                bool wrong);

}  // namespace si
