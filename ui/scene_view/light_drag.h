// What a light's settings become when one of its handles is dragged over the screen. No drawing.
#pragma once

#include <optional>
#include <string>

#include "ui/scene_view/light_handles.h"

namespace si {

/// A pose to start a drag from: what the fit chose is written into the settings as far as the handle calls for it, so
/// that it stays. Extent, near, far and a directional light's place and target turn light.fit to manual; place,
/// direction, cone and target of another only hold the distance, and its map is fitted anew; a range changes nothing
/// else; a directional light turns under its fit.
LightPose grab_light(const LightPose& pose, LightHandle handle, const FittedLight& fitted);

/// The light after `handle`, grabbed in the pose `start`, was dragged so that it appears at `to` (pixels); nothing when
/// no place of it can appear there.
/// @param step 0, or lengths go in steps of so many metres and angles in steps of 5 degrees
std::optional<LightSettings> drag_light(const LightPose& start, LightHandle handle, const PictureView& view,
                                        const glm::dvec2& to, double step = 0);

/// What of the lights a point of the picture shows: a handle of the shown one, the mark of another, or the pointer to
/// the shown one when it is outside the picture.
struct LightHit {
    int light = 0;
    std::optional<LightHandle> handle;
};

/// A drag under way.
struct HandleDrag {
    int light = 0;
    LightHandle handle = LightHandle::Position;
    LightPose start;
    LightSettings before;                    ///< what Escape restores
    glm::dvec2 handle_at{0}, pressed_at{0};  ///< pixels: the handle's place and the mouse's, at the press
    bool moved = false;                      ///< farther than a click wavers
    bool over = false;                       ///< ended by Escape; the button is still held
};

/// 1, 2 or 5 times a power of ten, about a fiftieth of the scene's radius; metres.
double snap_step(double scene_radius);

/// The numbers that the handle changes, with units. `pose` as the light is now.
std::string handle_numbers(const LightPose& pose, LightHandle handle);

}  // namespace si
