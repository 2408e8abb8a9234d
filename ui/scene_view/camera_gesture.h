// Changes of camera and light by mouse movements: pure functions of settings.
#pragma once

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "ui/scene_view/picture_view.h"

namespace si {

/// Turns the camera about its target. @param dx, dy mouse movement, pixels, y down
void orbit(CameraSettings& camera, double dx, double dy);
/// Moves camera and target so that the point at the focus stays under the mouse. @param height of the picture, pixels
void pan(CameraSettings& camera, const Camera& seen, double dx, double dy, int height);
/// Moves closer (positive steps of the wheel) or away. The point at the focus on the ray `towards` stays in place in
/// the picture.
void zoom(CameraSettings& camera, const Camera& seen, const Ray& towards, double steps);
/// Turns the camera about its own eye. @param dx, dy mouse movement, pixels, y down
void look_around(CameraSettings& camera, double dx, double dy);
/// Moves the camera to its right, upwards (world y) and forwards, metres. An orthographic camera narrows its view
/// instead of moving forwards, because distance does not change its picture.
void fly(CameraSettings& camera, const glm::dvec3& right_up_forward);
/// Looks at the camera's target along an axis (0 x, 1 y, 2 z), from its positive or negative side.
void look_along(CameraSettings& camera, int axis, bool positive);
/// Moves the camera along its direction of view until `bounds` fill the picture.
void look_at_bounds(CameraSettings& camera, const Bounds& bounds, double aspect);
/// Turns a light about its target, to the right of the picture and upwards with the mouse.
void turn_light(LightSettings& light, const Camera& seen, double dx, double dy);

}  // namespace si
