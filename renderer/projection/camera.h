// The camera of a picture and its projections.
#pragma once

#include <glm/glm.hpp>

#include "renderer/projection/depth_curve.h"

namespace si {

/// Camera of a picture: position, orientation, field of view and depth range.
struct Camera {
    glm::dvec3 eye{0};     ///< world
    glm::dmat3 axes{1.0};  ///< columns right, up, back
    bool orthographic = false;
    double fov_y_rad = 0.785;  ///< vertical field of view in perspective
    double height = 10;        ///< height of an orthographic picture, metres
    double focus = 10;         ///< distance to the target, metres
    DepthCurve curve;          ///< reversed-Z, zero to one
    double aspect = 1;         ///< width / height of the picture
    /// Returns the projection matrix of the picture's camera: clip space from view space.
    glm::dmat4 projection() const;
    /// Returns the camera's view-projection matrix for positions relative to `origin`, composed in double precision.
    /// Positions relative to a near origin stay precise in shaders.
    /// @param origin world
    glm::dmat4 clip_from_relative(const glm::dvec3& origin) const;
    /// Returns a world-space grid point near the camera's eye. Positions in shaders are relative to it, to stay
    /// precise. Small camera moves keep the same point.
    glm::dvec3 origin() const;
    /// Computes the world-space ray of this camera through a pixel's centre; (0,0) is the top left pixel.
    /// @param x,y pixel
    /// @param width,height size of the picture in pixels
    /// @param[out] ray_dir unit direction
    void pixel_ray(double x, double y, int width, int height, glm::dvec3& ray_origin, glm::dvec3& ray_dir) const;
    /// Projects a world-space point into the camera's picture. Returns (pixel x, pixel y, depth, w); w <= 0: the point
    /// lies behind the camera.
    /// @param width,height size of the picture in pixels
    glm::dvec4 project(const glm::dvec3& world, int width, int height) const;
    bool operator==(const Camera&) const = default;
};

}  // namespace si
