// Changes of camera and light by mouse movements: pure functions of settings.
#pragma once

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "ui/scene_view/picture_view.h"

namespace si {

/// Returns the point that the camera looks at, world.
glm::dvec3 target_of(const CameraSettings& camera);
/// Sets the point that the camera looks at, world.
void set_target(CameraSettings& camera, const glm::dvec3& target);
/// Orbits the camera about its target. @param dx, dy mouse movement, pixels, y down
void orbit_camera(CameraSettings& camera, double dx, double dy);
/// Pans the camera: moves eye and target so that the point at the focus stays under the mouse.
/// @param seen the camera of the picture @param dx, dy mouse movement, pixels, y down @param height picture height,
/// pixels
void pan_camera(CameraSettings& camera, const Camera& seen, double dx, double dy, int height);
/// Moves the camera closer to its focus or away from it. The point at the focus on the ray `towards` keeps its place in
/// the picture. @param seen the camera of the picture @param steps notches of the wheel; positive: closer
void zoom_camera(CameraSettings& camera, const Camera& seen, const Ray& towards, double steps);
/// Turns the camera about its own eye. @param dx, dy mouse movement, pixels, y down
void turn_camera(CameraSettings& camera, double dx, double dy);
/// Moves the camera to its right, upwards (world y) and forwards, metres. An orthographic camera narrows its view
/// instead of moving forwards, because distance does not change its picture.
void move_camera(CameraSettings& camera, const glm::dvec3& right_up_forward);
/// Turns the camera so that it looks at its target along a world axis. @param axis 0 x, 1 y, 2 z @param positive true:
/// looks from the axis's positive side
void look_along_axis(CameraSettings& camera, int axis, bool positive);
/// Moves the camera along its direction of view until `bounds` fill the picture.
void fill_picture_with(CameraSettings& camera, const Bounds& bounds, double aspect);
/// Turns a light about its target, following the mouse to the right and upwards in the picture.
/// @param seen the camera of the picture @param dx, dy mouse movement, pixels, y down
void turn_light(LightSettings& light, const Camera& seen, double dx, double dy);

}  // namespace si
