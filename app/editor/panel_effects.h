// What stands behind the editor's panels, as effects: each panel's work is called for while it is shown.
#pragma once

#include <vector>

#include "renderer/frame/effects.h"
#include "ui/state/editor_ui.h"

namespace si {

/// @param requests what the panels asked for
std::vector<Effect> panel_effects(const PictureState& state, const EditorRequests& requests);

/// Looking for clusters of wrong pixels, which is done once for each wish. @param now for the frame shown
Effect artefact_effect(const ArtefactRequest& request, const ArtefactSpots& found, bool now);

/// Rays that are traced in the background, or were.
Effect truth_effect(const TruthFacts& truth);

}  // namespace si
