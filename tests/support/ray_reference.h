// The truth about shadows of small scenes: every ray against every triangle, in double.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/view/lights/light.h"

namespace si::test {

struct Triangle {
    glm::dvec3 a, b, c;  ///< relative to the scene's centre
    glm::dvec3 normal;   ///< unit, by winding (mirrored objects: as drawn)
    int object = 0;
};

struct Hit {
    glm::dvec3 position;  ///< world
    glm::dvec3 normal;    ///< unit, towards the ray's origin
    int triangle = -1;
    double distance = 0;
};

class RayReference {
public:
    explicit RayReference(const Scene& scene);
    std::optional<Hit> first_hit(const glm::dvec3& origin_ws, const glm::dvec3& direction) const;
    /// Whether a triangle other than `own` lies between the point and the light, two-sided. Hits nearer than
    /// `least` metres do not count.
    bool occluded(const glm::dvec3& point_ws, const FittedLight& light, int own, double least = 0) const;
    std::size_t triangle_count() const { return triangles_.size(); }
    const Triangle& triangle(int i) const { return triangles_[std::size_t(i)]; }

private:
    /// The triangles of one object, and a ball that holds them.
    struct Group {
        std::size_t begin = 0, end = 0;
        glm::dvec3 centre{0};
        double radius = 0;
    };
    /// Calls `visit` with the number of each triangle whose group's ball the line meets, until it returns true.
    template <class Visit>
    bool along(const glm::dvec3& origin, const glm::dvec3& direction, Visit visit) const;

    std::vector<Triangle> triangles_;
    std::vector<Group> groups_;
    glm::dvec3 centre_{0};
    double radius_ = 1;
};

enum class Lit { Nothing, Away, Lit, Shadow, Boundary };

/// What each pixel should be, row by row from the top. Nothing: no geometry. Away: the surface is turned from the
/// light. Boundary: within `reach_texels` (per map axis, on the receiver's plane) the truth changes.
struct ReferenceImage {
    int width = 0, height = 0;
    std::vector<Lit> lit;
    std::vector<std::optional<Hit>> hits;
    Lit at(int x, int y) const { return lit[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

ReferenceImage trace_reference(const RayReference& scene, const Camera& camera, const FittedLight& light, int width,
                               int height, int map_resolution, double reach_texels);

/// Direction from a point towards the light, unit.
glm::dvec3 direction_to(const FittedLight& light, const glm::dvec3& point_ws);

/// The view of the light that a world point falls into (by its largest coordinate for six faces).
const LightView& view_of(const FittedLight& light, const glm::dvec3& point_ws);

/// Map coordinates and depth of a world point, and w, in double.
glm::dvec4 uvdw(const LightView& view, const glm::dvec3& point_ws);

}  // namespace si::test
