// Work of the editor's panels as rows of the panel Effects. A panel's work is needed while it is shown.
#pragma once

#include <vector>

#include "renderer/inspect/effects.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Lists the work of the editor's panels as rows of the panel Effects: needed while the panel is shown, with a reason.
std::vector<Effect> panel_effects(const PictureState& state, const EditorRequests& requests);

/// Returns the panel Effects' row about the search for clusters of wrong pixels.
/// @param now true: the search ran for the shown frame
Effect artefact_effect(const ArtefactRequest& request, const ArtefactSpots& found, bool now);

/// Returns the row of the panel Effects for the reference rays that are traced in the background.
Effect reference_effect(const ReferenceFacts& reference);

}  // namespace si
