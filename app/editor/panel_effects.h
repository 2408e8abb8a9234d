// Work of the editor's panels as rows of the panel Effects. A panel's work is needed while it is shown.
#pragma once

#include <vector>

#include "renderer/inspect/effects.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Lists the work of all panels, such as read-backs, as rows of the panel Effects (list of work with its state). A row
/// has the state *drawn* if a shown panel needs the work now, else *not needed*. Each row has a reason.
std::vector<Effect> panel_effects(const PictureState& state, const EditorRequests& requests);

/// Makes the row of the panel Effects that shows the search for clusters of wrong pixels. The panel lists the work of a
/// frame with its state.
/// @param request the last request for a search @param found result of the last search
/// @param now true: the search ran for the shown frame; false: for an earlier one
Effect artefact_effect(const ArtefactRequest& request, const ArtefactSpots& found, bool now);

/// Makes the row of the panel Effects that shows the tracing of the reference's rays. The panel lists each piece of a
/// frame's work as drawn, cached or not needed, with the reason. Rays are traced in the background.
Effect reference_effect(const ReferenceFacts& reference);

}  // namespace si
