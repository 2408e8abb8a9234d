// What mouse movements do to the camera and the light: pure functions of Settings.
#pragma once

#include "renderer/camera.h"

namespace si {

/// Turns the camera about its target; pixels of mouse movement, y down.
void orbit(CameraSettings& camera, double dx, double dy);
/// Moves the target so that the point at the focus stays under the cursor; `height` is the picture's, in pixels.
void pan(CameraSettings& camera, const Camera& seen, double dx, double dy, int height);
/// Moves closer (positive steps of the wheel) or away.
void zoom(CameraSettings& camera, double steps);
/// Keeps the direction of view and moves until `bounds` fill the picture.
void look_at_bounds(CameraSettings& camera, const Bounds& bounds, double aspect);
/// Turns a light about its target: right moves it to the right of the picture, up lifts it.
void turn_light(LightSettings& light, const Camera& seen, double dx, double dy);

}  // namespace si
