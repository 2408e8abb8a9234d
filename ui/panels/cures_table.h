// What would put wrong pixels right, as a table whose rows are applied by a click.
#pragma once

#include "ui/state/editor_ui.h"

namespace si {

/// The button that searches, or the search's progress. @param pixel what is to be cured; none: the picture
/// @param wrong there is something to cure
void cures_button(const EditorFrame& frame, EditorActions& actions, std::optional<glm::ivec2> pixel, bool wrong);
/// What was found for that, if anything was.
void cures_table(EditorState& state, const EditorFrame& frame, EditorActions& actions, std::optional<glm::ivec2> pixel);

}  // namespace si
