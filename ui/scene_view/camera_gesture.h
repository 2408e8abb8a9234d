// What mouse movements do to the camera and the light: pure functions of Settings.
#pragma once

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "ui/scene_view/picture_view.h"

namespace si {

/// Turns the camera about its target; pixels of mouse movement, y down.
void orbit(CameraSettings& camera, double dx, double dy);
/// Moves the target so that the point at the focus stays under the cursor; `height` is the picture's, in pixels.
void pan(CameraSettings& camera, const Camera& seen, double dx, double dy, int height);
/// Moves closer (positive steps of the wheel) or away; the point at the focus that `towards` shows stays where it is in
/// the picture.
void zoom(CameraSettings& camera, const Camera& seen, const Ray& towards, double steps);
/// Turns the camera about its own eye; pixels of mouse movement, y down.
void look_around(CameraSettings& camera, double dx, double dy);
/// Moves the camera to its right, upwards (world y) and forwards, metres. An orthographic camera, which sees no nearer
/// for being nearer, shows less instead.
void fly(CameraSettings& camera, const glm::dvec3& right_up_forward);
/// Looks along an axis at what the camera looks at: 0 x, 1 y, 2 z; from its positive or negative side.
void look_along(CameraSettings& camera, int axis, bool positive);
/// Keeps the direction of view and moves until `bounds` fill the picture.
void look_at_bounds(CameraSettings& camera, const Bounds& bounds, double aspect);
/// Turns a light about its target: right moves it to the right of the picture, up lifts it.
void turn_light(LightSettings& light, const Camera& seen, double dx, double dy);

}  // namespace si
