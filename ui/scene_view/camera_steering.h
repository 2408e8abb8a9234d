// The camera under mouse and keys in the scene picture: orbit, pan, zoom, fly, look through the light.
#pragma once

#include "ui/scene_view/picture_view.h"
#include "ui/state/editor_ui.h"

namespace si {

inline constexpr float kClickPixels = 3;  ///< a press that moves further is a drag

/// Call right after the picture's item, when nothing in the picture took the press. Sets state.viewport.press_moved and
/// state.viewport.dragging.
void steer_camera(EditorState& state, const EditorFrame& frame, const PictureView& view);

/// The camera by hand, so that it can be moved.
void take_camera(EditorState& state, const EditorFrame& frame);
/// Frames the selected object, or all of the scene when none is.
void frame_selection(EditorState& state, const EditorFrame& frame);
/// Frames all of the scene and a light that stands at `position`.
void frame_light(EditorState& state, const EditorFrame& frame, const glm::dvec3& position);
/// The scene's own camera, or the one that the scene suggests.
void reset_camera(EditorState& state, const EditorFrame& frame);
/// Looks through the shown light; a second call goes back to the camera before.
void toggle_light_camera(EditorState& state);
/// The camera of a frame, as settings that no light and no other camera moves.
FrozenCamera freeze(const FrameResult& result, const CameraSettings& settings);
/// Keeps the present camera as the frozen one, or lets go of it.
void toggle_frozen_camera(EditorState& state, const EditorFrame& frame);

}  // namespace si
