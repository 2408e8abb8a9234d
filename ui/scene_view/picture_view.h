// A scene picture on the screen: where a world point appears in it, and what lies under a point of the screen.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <utility>

#include "renderer/projection/camera.h"

namespace si {

struct Ray {
    glm::dvec3 origin{0}, direction{0, 0, -1};  ///< direction is unit
    double begin = 0;                           ///< metres along it; an orthographic camera sees behind its eye too
};

struct PictureView {
    Camera camera;
    glm::dvec2 origin{0}, size{1};  ///< whole pixels of the screen, y down
    double ui_scale = 1;            ///< of text and marks; 1 at about 96 dots per inch

    /// Nothing when the point lies behind the camera.
    std::optional<glm::dvec2> point(const glm::dvec3& world) const;
    /// The part of a segment in front of the camera; nothing when all is behind it.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> segment(const glm::dvec3& from, const glm::dvec3& to) const;
    Ray ray(const glm::dvec2& screen) const;
    /// World size of a screen pixel at the depth of a point in front of the camera.
    double metres_per_pixel(const glm::dvec3& world) const;
    bool contains(const glm::dvec2& screen) const;
};

/// Where a ray meets a plane; nothing when it runs along it or the place lies before the ray's beginning.
std::optional<glm::dvec3> meet_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal);
/// Metres from `origin` along a line (unit `direction`) to where a ray passes it closest; nothing when they are
/// parallel or that place lies before the ray's beginning.
std::optional<double> nearest_on_line(const Ray& ray, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace si
