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

/// Place of a camera's picture on the screen, which converts between pixels of the screen and the world.
struct PictureView {
    Camera camera;
    glm::dvec2 origin{0};  ///< upper left corner, whole pixels of the screen, y down
    glm::dvec2 size{1};    ///< whole pixels
    double ui_scale = 1;   ///< scale of text and marks; 1 at about 96 dots per inch

    /// Returns the position on the screen of a point in world space, pixels; nothing if the point is behind the camera.
    std::optional<glm::dvec2> point(const glm::dvec3& world) const;
    /// Returns a line segment in world space as a segment on the screen, pixels. Only the part in front of the camera
    /// counts; nothing if all of it is behind the camera.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> segment(const glm::dvec3& from, const glm::dvec3& to) const;
    /// Returns the camera's ray in world space through a point of the screen (pixels).
    Ray ray(const glm::dvec2& screen) const;
    /// Returns the size of a screen pixel in metres at the depth of a point in world space in front of the camera.
    double metres_per_pixel(const glm::dvec3& world) const;
    /// Returns true if a point of the screen (pixels) is inside the picture.
    bool contains(const glm::dvec2& screen) const;
};

/// Returns the intersection of a ray and a plane in world space. Nothing if ray and plane are parallel, or if the
/// intersection lies before the ray's start.
/// @param point any point of the plane @param normal normal of the plane
std::optional<glm::dvec3> intersect_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal);
/// Returns the point of a line that is closest to a ray, as metres from `origin` along `direction`. Returns nothing if
/// line and ray are parallel, or if the ray's closest point lies before its start.
/// @param origin point of the line @param direction unit vector along the line
std::optional<double> nearest_on_line(const Ray& ray, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace si
