// Playing an animation: scene.time runs with the clock.
#pragma once

#include "renderer/scene/animation.h"
#include "ui/state/editor_ui.h"

namespace si {

/// The animation that the settings choose; null when the scene has no such animation or the rest pose is shown.
const Animation* chosen_animation(const EditorFrame& frame, const SceneSettings& settings);

/// Starts or stops playing; from the start again when it had come to the end. Nothing without an animation of some
/// length. What playing has moved becomes one step of undo when it stops.
void toggle_play(EditorState& state, const EditorFrame& frame);
void stop_playing(EditorState& state);

/// One step back or forward; stops playing first, so that what it has moved can be undone too. A step of another scene
/// sets state.between_steps and comes once that scene is read.
void undo(EditorState& state);
void redo(EditorState& state);
/// Back or forward to that step of the history.
void go_to_step(EditorState& state, std::size_t step);

/// Lets `seconds` of the clock pass. Call once a frame, before anything starts or stops playing.
void play_on(EditorState& state, const EditorFrame& frame, double seconds);

}  // namespace si
