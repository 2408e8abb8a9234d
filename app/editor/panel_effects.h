// What stands behind the editor's panels, as effects: each panel's work is called for while it is shown.
#pragma once

#include <vector>

#include "renderer/frame/effects.h"
#include "ui/state/editor_ui.h"

namespace si {

/// @param actions what the panels asked for
std::vector<Effect> panel_effects(const PictureState& state, const EditorActions& actions);

/// Looking for clusters of wrong pixels, which is done once for each wish. @param now for the frame shown
Effect artefact_effect(const ArtefactWish& wish, const ArtefactSpots& found, bool now);

/// Rays that are traced in the background, or were.
Effect reference_effect(const ReferenceFacts& reference);

}  // namespace si
