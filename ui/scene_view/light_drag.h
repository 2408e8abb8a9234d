// A light's settings while one of its handles is dragged over the screen. No drawing.
#pragma once

#include <optional>
#include <string>

#include "ui/scene_view/light_handles.h"

namespace si {

/// Returns the pose that a drag starts from. Values chosen by the fit become settings as far as the handle needs it:
/// - extent, near, far, and a directional light's place and target set light.fit to manual;
/// - place, direction, cone and target of other lights keep the distance, and the map is fitted again;
/// - a range, and a directional light's direction, change nothing else.
LightPose grab_light(const LightPose& pose, LightHandle handle, const FittedLight& fitted);

/// Returns the light's settings with `handle` dragged to `to` (pixels); nothing if it cannot appear there.
/// @param start pose at the press @param step step of lengths, metres, with steps of 5 degrees for angles; 0: no steps
std::optional<LightSettings> drag_light(const LightPose& start, LightHandle handle, const PictureView& view,
                                        const glm::dvec2& to, double step = 0);

/// A light's mark in the picture: a handle of the shown light, or (without a handle) another light's mark or the
/// pointer to the shown light outside the picture.
struct LightHit {
    int light = 0;
    std::optional<LightHandle> handle;
};

/// A drag of a handle that is under way.
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

/// Returns a round step for lengths, metres: 1, 2 or 5 times a power of ten, about a fiftieth of the scene's radius.
double snap_step(double scene_radius);

/// Returns the numbers that the handle changes, with units. @param pose of the light as it is now
std::string handle_numbers(const LightPose& pose, LightHandle handle);

}  // namespace si
