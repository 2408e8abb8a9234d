// Mapping between a scene picture on the screen and the world.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <utility>

#include "renderer/projection/camera.h"

namespace si {

/// Ray in world space.
struct Ray {
    glm::dvec3 origin{0};
    glm::dvec3 direction{0, 0, -1};  ///< unit vector
    double begin = 0;                ///< start along the ray, metres; negative for orthographic cameras
};

/// Place of a camera's picture on the screen; converts between its pixels and the world.
struct PictureView {
    Camera camera;
    glm::dvec2 origin{0};  ///< upper left corner, whole pixels of the screen, y down
    glm::dvec2 size{1};    ///< whole pixels
    double ui_scale = 1;   ///< scale of text and marks; 1 at about 96 dots per inch

    /// Returns the position of a world point on the screen, pixels; nothing if the point is behind the camera.
    std::optional<glm::dvec2> point(const glm::dvec3& world) const;
    /// Returns the part of a world segment in front of the camera, on the screen, pixels; nothing if all of the segment
    /// is behind the camera.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> segment(const glm::dvec3& from, const glm::dvec3& to) const;
    /// Returns the camera's ray through a point of the screen (pixels), world.
    Ray ray(const glm::dvec2& screen) const;
    /// Returns the size of a screen pixel, metres, at the depth of a world point in front of the camera.
    double metres_per_pixel(const glm::dvec3& world) const;
    /// Returns true if a point of the screen (pixels) is inside the picture.
    bool contains(const glm::dvec2& screen) const;
};

/// Returns the intersection of a ray and a plane, world; nothing if they are parallel, or if the intersection lies
/// before the ray's start. @param point point of the plane
std::optional<glm::dvec3> intersect_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal);
/// Returns the point of a line that is closest to a ray, as metres from `origin` along the unit vector `direction`.
/// Returns nothing if line and ray are parallel, or if the ray's closest point lies before its start.
std::optional<double> nearest_on_line(const Ray& ray, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace si
