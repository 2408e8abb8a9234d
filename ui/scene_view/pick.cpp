#include "ui/scene_view/pick.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace si {
namespace {

struct LocalRay {
    glm::dvec3 origin, direction;  ///< not normalised, so that distances along the ray are equal in all spaces
    double begin;
};

bool meets_box(const LocalRay& ray, const Bounds& box, double end) {
    double from = ray.begin, to = end;
    for (int axis = 0; axis < 3; ++axis) {
        double a = (box.lo[axis] - ray.origin[axis]) / ray.direction[axis];
        double b = (box.hi[axis] - ray.origin[axis]) / ray.direction[axis];
        if (std::isnan(a) || std::isnan(b)) continue;  // the ray is parallel to a face
        if (a > b) std::swap(a, b);
        from = std::max(from, a);
        to = std::min(to, b);
    }
    return from <= to * (1 + 1e-9) + 1e-12;
}

// Möller, Trumbore: Fast, minimum storage ray/triangle intersection (1997).
std::optional<double> meet_triangle(const LocalRay& ray, const glm::dvec3& a, const glm::dvec3& b,
                                    const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(ray.direction, ac);
    const double det = glm::dot(ab, p);
    if (det == 0) return {};
    const glm::dvec3 s = ray.origin - a;
    const double u = glm::dot(s, p) / det;
    if (!(u >= 0 && u <= 1)) return {};
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(ray.direction, q) / det;
    if (!(v >= 0 && u + v <= 1)) return {};
    return glm::dot(ac, q) / det;
}

}  // namespace

std::string object_at(const Scene& scene, const Ray& ray) {
    double nearest = std::numeric_limits<double>::infinity();
    const Object* found = nullptr;
    for (const Object& o : scene.objects) {
        const Mesh& mesh = scene.meshes[std::size_t(o.mesh)];
        const glm::dmat4 to_local = glm::inverse(o.world);
        const LocalRay local{glm::dvec3(to_local * glm::dvec4(ray.origin, 1)),
                             glm::dvec3(to_local * glm::dvec4(ray.direction, 0)), ray.begin};
        if (mesh.bounds.empty() || !meets_box(local, mesh.bounds, nearest)) continue;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
            const auto at = meet_triangle(local, corner(0), corner(1), corner(2));
            if (at && *at >= ray.begin && *at < nearest) {
                nearest = *at;
                found = &o;
            }
        }
    }
    return found ? scene.nodes[std::size_t(found->node)].path : std::string();
}

}  // namespace si
