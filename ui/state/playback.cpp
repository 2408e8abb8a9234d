#include "ui/state/playback.h"

#include <algorithm>
#include <cmath>

namespace si {

const Animation* chosen_animation(const EditorFrame& frame, const SceneSettings& settings) {
    if (!frame.scene || !frame.scene->rig || settings.animation < 0) return nullptr;
    const auto& all = frame.scene->rig->animations;
    return std::size_t(settings.animation) < all.size() ? &all[std::size_t(settings.animation)] : nullptr;
}

namespace {

/// Applies a step of undo at once if it belongs to the shown scene, read with the same file choices; else the step
/// waits for its scene.
void show_step(EditorState& state, const Settings& settings) {
    const Place& place = state.history.place();
    const bool reads_again = file_choices(settings.scene) != file_choices(state.settings.scene);
    state.between_steps = !place.scene.empty() && (place.scene != state.scene_name || reads_again);
    if (state.between_steps) return;
    state.settings = settings;
    state.files.guide = place.guide;
}

}  // namespace

void toggle_play(EditorState& state, const EditorFrame& frame) {
    if (state.playback.playing) return stop_playing(state);
    const Animation* animation = chosen_animation(frame, state.settings.scene);
    if (!animation || !(animation->duration_s > 0)) return;
    state.playback.playing = true;
    if (state.settings.scene.time >= animation->duration_s) {
        state.settings.scene.time = 0;
        state.history.set_time(0);
    }
}

void stop_playing(EditorState& state) {
    if (!state.playback.playing) return;
    state.playback.playing = false;
    state.history.commit(state.settings);
}

void undo(EditorState& state) {
    if (state.between_steps) return;
    stop_playing(state);
    show_step(state, state.history.undo());
}

void redo(EditorState& state) {
    if (state.between_steps) return;
    stop_playing(state);
    show_step(state, state.history.redo());
}

void go_to_step(EditorState& state, std::size_t step) {
    if (state.between_steps || step == state.history.index()) return;
    stop_playing(state);
    show_step(state, state.history.go_to(step));
}

void advance_animation(EditorState& state, const EditorFrame& frame, double seconds) {
    if (!state.playback.playing) return;
    const Animation* animation = chosen_animation(frame, state.settings.scene);
    if (!animation || !(animation->duration_s > 0)) return stop_playing(state);
    const double end = animation->duration_s;
    double time = state.settings.scene.time + std::max(seconds, 0.0) * state.playback.speed;
    const bool ended = time >= end && !state.playback.loop;
    if (ended)
        time = end;
    else if (time >= end)
        time = std::fmod(time, end);
    state.settings.scene.time = time;
    state.history.set_time(time);
    if (ended) stop_playing(state);
}

}  // namespace si
