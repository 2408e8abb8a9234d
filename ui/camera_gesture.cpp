#include "ui/camera_gesture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace si {
namespace {

constexpr double kDegreesPerPixel = 0.35;
constexpr double kZoomPerStep = 0.88;

double wrapped(double degrees) {
    return std::remainder(degrees, 360.0);
}

}  // namespace

void orbit(CameraSettings& camera, double dx, double dy) {
    camera.azimuth = wrapped(camera.azimuth - dx * kDegreesPerPixel);
    camera.elevation = std::clamp(camera.elevation + dy * kDegreesPerPixel, -90.0, 90.0);
}

void pan(CameraSettings& camera, const Camera& seen, double dx, double dy, int height) {
    const double seen_height = seen.orthographic ? seen.height : 2 * seen.focus * std::tan(0.5 * seen.fov_y_rad);
    const double metres = seen_height / std::max(height, 1);
    const glm::dvec3 move = (-dx * metres) * seen.axes[0] + (dy * metres) * seen.axes[1];
    camera.target_x += move.x;
    camera.target_y += move.y;
    camera.target_z += move.z;
}

void zoom(CameraSettings& camera, double steps) {
    const double factor = std::pow(kZoomPerStep, steps);
    camera.distance = std::clamp(camera.distance * factor, 1e-6, 1e7);
    camera.height = std::clamp(camera.height * factor, 1e-6, 1e7);
}

void look_at_bounds(CameraSettings& camera, const Bounds& bounds, double aspect) {
    if (bounds.empty()) return;
    const glm::dvec3 centre = bounds.centre();
    camera.target_x = centre.x;
    camera.target_y = centre.y;
    camera.target_z = centre.z;
    const double radius = std::max(bounds.radius(), 1e-6);
    const double half_y = 0.5 * camera.fov * std::numbers::pi / 180;
    const double half_x = std::atan(std::tan(half_y) * std::max(aspect, 1e-3));
    camera.distance = radius / std::sin(std::min(half_x, half_y));
    camera.height = 2 * radius / std::min(1.0, std::max(aspect, 1e-3));
    camera.near = camera.far = 0;
}

void turn_light(LightSettings& light, const Camera& seen, double dx, double dy) {
    // Seen from above the light goes round counter-clockwise; a light behind the scene moves the other way in the
    // picture than one in front of it.
    const glm::dvec3 to_light = direction_from_angles(light.azimuth, 0);
    const double side = glm::dot(to_light, seen.axes[2]) >= 0 ? 1.0 : -1.0;
    light.azimuth = wrapped(light.azimuth + side * dx * kDegreesPerPixel);
    light.elevation = std::clamp(light.elevation - dy * kDegreesPerPixel, -90.0, 90.0);
}

}  // namespace si
