// Work of the editor's panels as rows of the panel Effects. A panel's work is needed while it is shown.
#pragma once

#include <vector>

#include "renderer/inspect/effects.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Returns a row for the work of each panel: drawn while needed, with the reason.
std::vector<Effect> panel_effects(const PictureState& state, const EditorRequests& requests);

/// Returns the row of the search for clusters of wrong pixels, which runs once a request.
/// @param now it ran for the frame that is shown
Effect artefact_effect(const ArtefactRequest& request, const ArtefactSpots& found, bool now);

/// Returns the row of the rays that are traced in the background.
Effect reference_effect(const ReferenceFacts& reference);

}  // namespace si
