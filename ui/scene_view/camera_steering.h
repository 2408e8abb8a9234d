// The camera under mouse and keys in the scene picture: orbit, pan, zoom, fly, look through the light.
#pragma once

#include "ui/scene_view/picture_view.h"
#include "ui/state/editor_ui.h"

namespace si {

inline constexpr float kClickPixels = 3;  ///< movement beyond which a press is a drag, pixels

/// Moves the camera by mouse and keys over the scene picture. A drag with Ctrl turns the shown light instead. Call
/// right after the picture's ImGui item, unless state.viewport.press_taken is set. The press then belongs to a light,
/// the gnomon or the dividing line of a comparison. Sets state.viewport.press_moved and state.viewport.dragging.
void steer_camera(EditorState& state, const EditorFrame& frame, const PictureView& view);

/// Copies the picture's present camera into manual settings (camera.source), so that gestures can move it.
void take_camera(EditorState& state, const EditorFrame& frame);
/// Moves the camera until the selected objects fill the picture, or the whole scene if no object is selected.
void frame_selection(EditorState& state, const EditorFrame& frame);
/// Moves the camera until the scene and a light at `position` fill the picture.
void frame_light(EditorState& state, const EditorFrame& frame, const glm::dvec3& position);
/// Resets all settings camera.* but camera.index to their defaults, with which the scene's own camera is used. Then
/// applies those settings camera.* that the scene suggests (Scene::suggested).
void reset_camera(EditorState& state, const EditorFrame& frame);
/// Switches the picture between the view from the shown light and the camera that was in use before.
void toggle_light_camera(EditorState& state);
/// Returns the camera of a frame as a frozen camera, for which shadow maps are made while another camera moves.
/// @param settings camera settings of the frame
FrozenCamera frozen_camera_of(const FrameResult& result, const CameraSettings& settings);
/// Freezes the present camera, so that shadow maps are made for it while another camera moves. A second call releases
/// the frozen camera.
void toggle_frozen_camera(EditorState& state, const EditorFrame& frame);

}  // namespace si
