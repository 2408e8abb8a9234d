// Playing an animation: scene.time runs with the clock.
#pragma once

#include "renderer/scene/animation.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Returns the chosen animation; null: the scene has no such animation, or the rest pose is shown.
const Animation* chosen_animation(const EditorFrame& frame, const SceneSettings& settings);

/// Starts or stops the chosen animation; starts from the beginning after the end. Does nothing without an animation of
/// some length. The change of scene.time becomes one step of undo at the stop.
void toggle_play(EditorState& state, const EditorFrame& frame);
/// Stops the playing animation and records the change of scene.time as a step of undo.
void stop_playing(EditorState& state);

/// Undoes the last step of the history. Stops a playing animation first, so that its change can be undone, too. A step
/// of another scene sets state.between_steps and is shown once that scene is loaded.
void undo(EditorState& state);
/// Redoes the next step of the history. A step of another scene is shown once that scene is loaded, as in undo().
void redo(EditorState& state);
/// Goes to any step of the history, back or forward. Stops a playing animation first. A step of another scene is shown
/// once that scene is loaded, as in undo(). @param step the index of the step
void go_to_step(EditorState& state, std::size_t step);

/// Advances scene.time by `seconds` while the animation plays. Call once a frame, before the panels are drawn.
void advance_animation(EditorState& state, const EditorFrame& frame, double seconds);

}  // namespace si
