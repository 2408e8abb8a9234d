// A light's settings while one of its handles is dragged over the screen. No drawing.
#pragma once

#include <optional>
#include <string>

#include "ui/scene_view/light_handles.h"

namespace si {

/// Returns the pose (position, direction and settings) from which a drag of a light's handle starts. Values that the
/// light's fit (the rule for what its map covers) has chosen become settings, as far as the handle needs them:
/// - Handles for extent, near and far of every light, and for place and target of a directional light: all fitted
///   values become settings, and light.fit becomes manual.
/// - Handles for place, direction, cone and target of a spot or point light: the fitted distance becomes
///   light.distance, and the map is fitted again.
/// - Handles for the range of every light, and for the direction of a directional light: no fitted value becomes a
///   setting.
LightPose grab_light(const LightPose& pose, LightHandle handle, const FittedLight& fitted);

/// Returns the light's settings after a drag of `handle` to the place `to` on the screen (pixels). Nothing if the
/// handle cannot follow the mouse: its line of movement is parallel to the line of sight, or the handle would lie
/// behind the camera.
/// @param start the pose at the press of the button (grab_light())
/// @param step step of lengths, metres (angles then step by 5 degrees); 0: no steps
std::optional<LightSettings> drag_light(const LightPose& start, LightHandle handle, const PictureView& view,
                                        const glm::dvec2& to, double step = 0);

/// Mark of a light under the mouse in the scene picture. It is a handle of the shown light, the mark of another light,
/// or the arrow that points to the shown light outside the picture.
struct LightHit {
    int light = 0;
    std::optional<LightHandle> handle;
};

/// State of the drag of a light's handle that is under way.
struct HandleDrag {
    int light = 0;
    LightHandle handle = LightHandle::Position;
    LightPose start;
    LightSettings before;      ///< light to go back to when the drag is cancelled
    glm::dvec2 handle_at{0};   ///< place of the handle at the press, pixels
    glm::dvec2 pressed_at{0};  ///< place of the mouse at the press, pixels
    bool moved = false;        ///< the mouse has moved farther than in a click
    bool over = false;         ///< cancelled, while the button is still held
};

/// Returns the step in metres to which lengths snap while a light is dragged with Ctrl. It is 1, 2 or 5 times a power
/// of ten, about a fiftieth of the scene's radius. @param scene_radius metres
double snap_step(double scene_radius);

/// Formats the numbers that a drag of a light's handle changes, with units. @param pose the present pose of the light
std::string handle_numbers(const LightPose& pose, LightHandle handle);

}  // namespace si
