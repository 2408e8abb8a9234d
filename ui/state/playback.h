// Playing an animation: scene.time runs with the clock.
#pragma once

#include "renderer/scene/animation.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Returns the chosen animation; null: the scene has no such animation, or the rest pose is shown.
const Animation* chosen_animation(const EditorFrame& frame, const SceneSettings& settings);

/// Starts or stops playing; starts over after the end. Does nothing without an animation of some length. The change of
/// scene.time becomes one step of undo when it stops.
void toggle_play(EditorState& state, const EditorFrame& frame);
/// Stops playing and records its step of undo.
void stop_playing(EditorState& state);

/// Goes one step of the history back. Stops playing first, so that its change can be undone, too. A step of another
/// scene sets state.between_steps and is shown once that scene is read.
void undo(EditorState& state);
/// Goes one step of the history forward, as undo() goes back.
void redo(EditorState& state);
/// Goes to a step of the history, as undo() does.
void go_to_step(EditorState& state, std::size_t step);

/// Advances scene.time by `seconds` while the animation plays. Call once a frame, before anything starts or stops it.
void play_on(EditorState& state, const EditorFrame& frame, double seconds);

}  // namespace si
