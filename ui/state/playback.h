// Playing an animation: scene.time runs with the clock.
#pragma once

#include "renderer/scene/animation.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Returns the animation that scene.animation chooses; null: the scene has no such animation, or the rest pose is
/// shown.
const Animation* chosen_animation(const EditorFrame& frame, const SceneSettings& settings);

/// Starts or stops the chosen animation. At the end of the animation, starts from the beginning. Does nothing if there
/// is no animation, or its length is 0. When the animation stops, the change of scene.time becomes one step of undo.
void toggle_play(EditorState& state, const EditorFrame& frame);
/// Stops the playing animation and records the change of scene.time as a step of undo.
void stop_playing(EditorState& state);

/// Undoes the last change of settings (the last step of the history). Stops a playing animation first and undoes its
/// change of time. A step of another scene, or with another scene.index, scene.up or scene.unit, sets
/// state.between_steps and is shown when its scene has been loaded.
void undo(EditorState& state);
/// Redoes the change of settings that was undone last. A step of another scene is shown when its scene has been loaded,
/// as in undo().
void redo(EditorState& state);
/// Goes to any step of the undo history, back or forward. Stops a playing animation first. A step of another scene is
/// shown when its scene has been loaded, as in undo(). @param step the index of the step
void go_to_step(EditorState& state, std::size_t step);

/// Advances scene.time while the animation plays, and stops the animation at its end unless it loops. Call once a
/// frame, before the panels are drawn. @param seconds time since the last frame
void advance_animation(EditorState& state, const EditorFrame& frame, double seconds);

}  // namespace si
