// The camera of a picture, and its projections.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/depth_curve.h"

namespace si {

struct Camera {
    glm::dvec3 eye{0};
    glm::dmat3 axes{1.0};  ///< columns right, up, back
    bool orthographic = false;
    double fov_y_rad = 0.785;
    double height = 10;  ///< orthographic: metres seen vertically
    double focus = 10;   ///< distance to the target, metres
    DepthCurve curve;    ///< reversed-Z, zero to one
    double aspect = 1;
    glm::dmat4 projection() const;
    glm::dmat4 clip_from_relative(const glm::dvec3& origin) const;
    /// A grid point near the eye, so that small moves of the camera leave it where it is.
    glm::dvec3 origin() const;
    /// World-space ray through a pixel's centre; (0,0) is the top left pixel.
    void pixel_ray(double x, double y, int width, int height, glm::dvec3& ray_origin, glm::dvec3& ray_dir) const;
    /// Pixel position and depth of a world point; z <= 0 in `w` means behind the camera.
    glm::dvec4 project(const glm::dvec3& world, int width, int height) const;  // x, y, depth, w
    bool operator==(const Camera&) const = default;
};

}  // namespace si
