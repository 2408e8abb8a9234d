// Changes of camera and light by mouse movements: pure functions of settings.
#pragma once

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "ui/scene_view/picture_view.h"

namespace si {

/// Returns the point in world space that the camera looks at, metres.
glm::dvec3 target_of(const CameraSettings& camera);
/// Sets the point in world space that the camera looks at, metres. Angles and distance of the camera stay.
void set_target(CameraSettings& camera, const glm::dvec3& target);
/// Orbits the camera about the point that it looks at. @param dx, dy mouse movement, pixels, y down
void orbit_camera(CameraSettings& camera, double dx, double dy);
/// Pans the camera: moves the eye and the point that it looks at, so that this point stays under the mouse.
/// @param seen camera with which the picture was drawn @param dx, dy mouse movement, pixels, y down
/// @param height picture height, pixels
void pan_camera(CameraSettings& camera, const Camera& seen, double dx, double dy, int height);
/// Zooms the camera towards the mouse: moves it closer to the point that it looks at, or away. At the depth of that
/// point, the place under the mouse keeps its position in the picture. An orthographic camera narrows or widens its
/// view.
/// @param seen camera with which the picture was drawn @param towards ray through the mouse @param steps notches of the
/// wheel; positive: closer
void zoom_camera(CameraSettings& camera, const Camera& seen, const Ray& towards, double steps);
/// Turns the camera about its own eye, for looking around while flying. @param dx, dy mouse movement, pixels, y down
void turn_camera(CameraSettings& camera, double dx, double dy);
/// Moves the camera to its right, upwards (world y) and forwards, metres. An orthographic camera narrows its view
/// instead of moving forwards, because distance does not change its picture.
void move_camera(CameraSettings& camera, const glm::dvec3& right_up_forward);
/// Turns the camera about the point that it looks at, so that it looks along a world axis.
/// @param axis 0 x, 1 y, 2 z @param positive true: from the axis's positive side; false: from its negative side
void look_along_axis(CameraSettings& camera, int axis, bool positive);
/// Moves the camera sideways and along its view, without turning it, so that the box `bounds` fills the picture. The
/// camera then looks at the middle of the box. Near and far planes become automatic. An empty box changes nothing.
/// @param aspect width / height of the picture
void fill_picture_with(CameraSettings& camera, const Bounds& bounds, double aspect);
/// Turns a light about its target, following the mouse to the right and upwards in the picture.
/// @param seen camera with which the picture was drawn @param dx, dy mouse movement, pixels, y down
void turn_light(LightSettings& light, const Camera& seen, double dx, double dy);

}  // namespace si
