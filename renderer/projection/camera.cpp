#include "renderer/projection/camera.h"

#include <cmath>

#include "renderer/projection/projection.h"

namespace si {

glm::dmat4 Camera::projection() const {
    const double half = orthographic ? 0.5 * height : std::tan(0.5 * fov_y_rad);
    return projection_matrix(curve, half * aspect, half);
}

glm::dmat4 Camera::clip_from_relative(const glm::dvec3& origin) const {
    return si::clip_from_relative(projection(), axes, eye, origin);
}

glm::dvec3 Camera::origin() const {
    const double spacing = std::exp2(std::ceil(std::log2(4 * focus)));
    return glm::round(eye / spacing) * spacing;
}

void Camera::pixel_ray(double x, double y, int width, int height_px, glm::dvec3& ray_origin,
                       glm::dvec3& ray_dir) const {
    const double half = orthographic ? 0.5 * height : std::tan(0.5 * fov_y_rad);
    const double vx = ((x + 0.5) / width * 2 - 1) * half * aspect, vy = (1 - (y + 0.5) / height_px * 2) * half;
    if (orthographic) {
        ray_origin = eye + axes * glm::dvec3(vx, vy, 0);
        ray_dir = -axes[2];
    } else {
        ray_origin = eye;
        ray_dir = glm::normalize(axes * glm::dvec3(vx, vy, -1));
    }
}

glm::dvec4 Camera::project(const glm::dvec3& world, int width, int height_px) const {
    const glm::dvec4 clip = projection() * glm::dvec4(glm::transpose(axes) * (world - eye), 1.0);
    const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
    return {(ndc.x + 1) / 2 * width - 0.5, (1 - ndc.y) / 2 * height_px - 0.5, uvd_from_ndc(curve.convention, ndc).z,
            clip.w};
}

}  // namespace si
