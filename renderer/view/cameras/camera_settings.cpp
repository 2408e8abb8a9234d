#include "renderer/view/cameras/camera_settings.h"

#include <cmath>

#include "renderer/base/angles.h"
#include "renderer/view/cameras/framing.h"

namespace si {

CameraSettings camera_settings(const Camera& c) {
    CameraSettings s;
    s.source = CameraSource::Manual;
    const glm::dvec3 back = c.axes[2];
    const double level = std::hypot(back.x, back.z);
    // Looking straight up or down, the azimuth is arbitrary; roll then sets the orientation.
    s.azimuth = level > 1e-12 ? std::atan2(back.x, back.z) / kDegree : 0;
    s.elevation = std::atan2(back.y, level) / kDegree;
    const glm::dmat3 level_axes = orbit_axes(s.azimuth, s.elevation, 0);
    s.roll = std::atan2(glm::dot(c.axes[0], level_axes[1]), glm::dot(c.axes[0], level_axes[0])) / kDegree;
    const glm::dvec3 target = c.eye - c.focus * back;
    s.target_x = target.x;
    s.target_y = target.y;
    s.target_z = target.z;
    s.distance = c.focus;
    s.fov = c.fov_y_rad / kDegree;
    s.orthographic = c.orthographic;
    s.height = c.height;
    return s;
}

}  // namespace si
