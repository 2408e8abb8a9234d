// Mapping between a scene picture on the screen and the world.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <utility>

#include "renderer/projection/camera.h"

namespace si {

/// A ray, world.
struct Ray {
    glm::dvec3 origin{0};
    glm::dvec3 direction{0, 0, -1};  ///< unit vector
    double begin = 0;                ///< start along the ray, metres; negative for orthographic cameras
};

/// A camera's picture on the screen.
struct PictureView {
    Camera camera;
    glm::dvec2 origin{0};  ///< upper left corner, whole pixels of the screen, y down
    glm::dvec2 size{1};    ///< whole pixels
    double ui_scale = 1;   ///< of text and marks; 1 at about 96 dots per inch

    /// Returns the place of a world point on the screen; nothing if it is behind the camera.
    std::optional<glm::dvec2> point(const glm::dvec3& world) const;
    /// Returns the part of a segment in front of the camera, on the screen; nothing if all is behind it.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> segment(const glm::dvec3& from, const glm::dvec3& to) const;
    /// Returns the camera's ray through a point of the screen.
    Ray ray(const glm::dvec2& screen) const;
    /// Returns the world size of a screen pixel at the depth of a point in front of the camera.
    double metres_per_pixel(const glm::dvec3& world) const;
    /// Returns true if the point of the screen is inside the picture.
    bool contains(const glm::dvec2& screen) const;
};

/// Returns the intersection of a ray and a plane; nothing if they are parallel, or it lies before the ray's start.
std::optional<glm::dvec3> intersect_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal);
/// Returns the place along a line (metres from `origin`, unit `direction`) that is closest to a ray; nothing if they
/// are parallel, or it lies before the ray's start.
std::optional<double> nearest_on_line(const Ray& ray, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace si
