// The camera as the settings and the scene make it.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "renderer/view/fits/light_fit.h"

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

/// The camera that the settings ask for: by hand, through the light shown in view.light (its view, near and far planes
/// included; the map's square fills the shorter side of the picture), or (automatic) the scene's own, or one that
/// frames the bounds. Where there is no light to look through it is the automatic one.
/// @param as_placed fit_maps() of these settings' lights without a camera; fitted here when there are none and one is
///     needed
Camera make_camera(const Scene& scene, const Settings& settings, double aspect,
                   std::span<const FittedLight> as_placed = {});

/// `settings` with the camera that make_camera() finds written out by hand, so that it can be moved. A light's near and
/// far planes stay behind: as the camera moves away they would cut the scene at odd places.
/// @param aspect the picture's width / height, on which the automatic framing depends
CameraSettings manual_camera(const Scene& scene, const Settings& settings, double aspect = 16.0 / 9.0);

}  // namespace si
