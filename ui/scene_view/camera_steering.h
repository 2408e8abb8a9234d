// The camera under mouse and keys in the scene picture: orbit, pan, zoom, fly, look through the light.
#pragma once

#include "ui/scene_view/picture_view.h"
#include "ui/state/editor_ui.h"

namespace si {

inline constexpr float kClickPixels = 3;  ///< movement beyond which a press is a drag, pixels

/// Moves the camera by mouse and keys over the scene picture. Call right after the picture's ImGui item, unless a mark
/// in the picture has taken the press. Sets state.viewport.press_moved and state.viewport.dragging.
void steer_camera(EditorState& state, const EditorFrame& frame, const PictureView& view);

/// Sets camera.source to manual with the present camera, so that it can be moved.
void take_camera(EditorState& state, const EditorFrame& frame);
/// Moves the camera until the selected objects fill the picture; without a selection the scene.
void frame_selection(EditorState& state, const EditorFrame& frame);
/// Moves the camera until the scene and a light at `position` fill the picture.
void frame_light(EditorState& state, const EditorFrame& frame, const glm::dvec3& position);
/// Resets the camera to the scene's own one, or to the one that the scene suggests.
void reset_camera(EditorState& state, const EditorFrame& frame);
/// Switches between the view through the shown light and the camera before.
void toggle_light_camera(EditorState& state);
/// Returns a frame's camera as a frozen camera, with manual settings. @param settings the frame's camera settings
FrozenCamera frozen_camera_of(const FrameResult& result, const CameraSettings& settings);
/// Freezes the present camera, or releases the frozen one.
void toggle_frozen_camera(EditorState& state, const EditorFrame& frame);

}  // namespace si
