#include "ui/scene_view/camera_gesture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/base/directions.h"
#include "renderer/view/cameras/framing.h"

namespace si {
namespace {

constexpr double kDegreesPerPixel = 0.35;
constexpr double kDegreesPerLookPixel = 0.18;
constexpr double kZoomPerStep = 0.88;
constexpr double kMinDistance = 1e-6, kMaxDistance = 1e7;  // m

double wrapped(double degrees) {
    return std::remainder(degrees, 360.0);
}

glm::dvec3 back_of(const CameraSettings& camera) {
    return direction_from_angles(camera.azimuth, camera.elevation);
}

}  // namespace

glm::dvec3 target_of(const CameraSettings& camera) {
    return {camera.target_x, camera.target_y, camera.target_z};
}

void set_target(CameraSettings& camera, const glm::dvec3& target) {
    camera.target_x = target.x;
    camera.target_y = target.y;
    camera.target_z = target.z;
}

void orbit_camera(CameraSettings& camera, double dx, double dy) {
    camera.azimuth = wrapped(camera.azimuth - dx * kDegreesPerPixel);
    camera.elevation = std::clamp(camera.elevation + dy * kDegreesPerPixel, -90.0, 90.0);
}

void pan_camera(CameraSettings& camera, const Camera& seen, double dx, double dy, int height) {
    const double seen_height = seen.orthographic ? seen.height : 2 * seen.focus * std::tan(0.5 * seen.fov_y_rad);
    const double metres = seen_height / std::max(height, 1);
    const glm::dvec3 move = (-dx * metres) * seen.axes[0] + (dy * metres) * seen.axes[1];
    set_target(camera, target_of(camera) + move);
}

void zoom_camera(CameraSettings& camera, const Camera& seen, const Ray& towards, double steps) {
    const double wanted = std::pow(kZoomPerStep, steps);
    double& size = seen.orthographic ? camera.height : camera.distance;
    const double factor = std::clamp(size * wanted, kMinDistance, kMaxDistance) / size;
    const glm::dvec3 target = target_of(camera);
    if (const auto at = intersect_plane(towards, target, seen.axes[2]))
        set_target(camera, *at + factor * (target - *at));
    camera.distance = std::clamp(camera.distance * factor, kMinDistance, kMaxDistance);
    camera.height = std::clamp(camera.height * factor, kMinDistance, kMaxDistance);
}

void turn_camera(CameraSettings& camera, double dx, double dy) {
    const glm::dvec3 eye = target_of(camera) + camera.distance * back_of(camera);
    camera.azimuth = wrapped(camera.azimuth - dx * kDegreesPerLookPixel);
    camera.elevation = std::clamp(camera.elevation + dy * kDegreesPerLookPixel, -90.0, 90.0);
    set_target(camera, eye - camera.distance * back_of(camera));
}

void move_camera(CameraSettings& camera, const glm::dvec3& move) {
    const double azimuth = camera.azimuth * std::numbers::pi / 180;
    const glm::dvec3 right(std::cos(azimuth), 0, -std::sin(azimuth));
    set_target(camera, target_of(camera) + move.x * right + move.y * glm::dvec3(0, 1, 0) - move.z * back_of(camera));
    if (camera.orthographic)
        camera.height = std::clamp(camera.height * std::exp(-move.z / camera.distance), kMinDistance, kMaxDistance);
}

void look_along_axis(CameraSettings& camera, int axis, bool positive) {
    camera.roll = 0;
    camera.elevation = axis != 1 ? 0 : positive ? 90 : -90;
    camera.azimuth = axis == 0 ? (positive ? 90 : -90) : axis == 2 && !positive ? 180 : 0;
}

void fill_picture_with(CameraSettings& camera, const Bounds& bounds, double aspect) {
    if (bounds.empty()) return;
    Camera seen;
    seen.axes = orbit_axes(camera.azimuth, camera.elevation, camera.roll);
    seen.aspect = std::max(aspect, 1e-3);
    seen.fov_y_rad = camera.fov * std::numbers::pi / 180;
    frame_bounds(seen, bounds);
    set_target(camera, bounds.centre());
    camera.distance = std::max(seen.focus, kMinDistance);
    camera.height = std::max(seen.height, kMinDistance);
    camera.near = camera.far = 0;
}

void turn_light(LightSettings& light, const Camera& seen, double dx, double dy) {
    // The light turns counter-clockwise as seen from above; in the picture, a light behind the scene moves the opposite
    // way of one in front.
    const glm::dvec3 to_light = direction_from_angles(light.azimuth, 0);
    const double side = glm::dot(to_light, seen.axes[2]) >= 0 ? 1.0 : -1.0;
    light.azimuth = wrapped(light.azimuth + side * dx * kDegreesPerPixel);
    light.elevation = std::clamp(light.elevation - dy * kDegreesPerPixel, -90.0, 90.0);
}

}  // namespace si
