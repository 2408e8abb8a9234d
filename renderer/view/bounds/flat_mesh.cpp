#include "renderer/view/bounds/flat_mesh.h"

#include <algorithm>
#include <cmath>

namespace si {
namespace {

/// Number of triangles searched for the largest, which gives the plane.
constexpr std::size_t kMaxPlaneTriangles = 64;

/// Largest number of vertex-triangle tests for convexity.
constexpr std::size_t kMaxTests = 1 << 18;

/// Largest rounding of vertices as a share of the radius. Shadows of smaller relief matter to no texel of a map.
constexpr double kMaxRoundingOfRadius = 1e-4;

/// Flatness tolerance of a mesh in the space of the mesh, metres. Rounding above kMaxRoundingOfRadius is relief that
/// casts shadows.
double tolerance_of(const Mesh& mesh) {
    const double radius = mesh.bounds.radius();
    const double farthest = std::max(glm::length(glm::max(glm::abs(mesh.bounds.lo), glm::abs(mesh.bounds.hi))), radius);
    return std::max(flat_tolerance(radius), std::min(0x1p-22 * farthest, kMaxRoundingOfRadius * radius));
}

}  // namespace

std::optional<HalfSpace> mesh_plane(const Mesh& mesh) {
    const std::size_t count = mesh.indices.size() / 3;
    glm::dvec3 normal(0), at(0);
    const auto corner = [&](std::size_t i) { return glm::dvec3(mesh.positions[mesh.indices[i]]); };
    for (std::size_t i = 0; i < std::min(count, kMaxPlaneTriangles); ++i) {
        const std::size_t t = count <= kMaxPlaneTriangles ? i : i * (count / kMaxPlaneTriangles);
        const glm::dvec3 a = corner(3 * t), n = glm::cross(corner(3 * t + 1) - a, corner(3 * t + 2) - a);
        if (glm::dot(n, n) > glm::dot(normal, normal)) {
            normal = n;
            at = a;
        }
    }
    const double area = glm::length(normal);
    if (!(area > 0) || !std::isfinite(area)) return std::nullopt;
    const HalfSpace plane = HalfSpace::through(at, normal / area);
    const double tolerance = tolerance_of(mesh);
    for (const std::uint32_t i : mesh.indices)
        if (!(std::abs(plane.distance(glm::dvec3(mesh.positions[i]))) <= tolerance)) return std::nullopt;
    return plane;
}

bool is_convex(const Mesh& mesh) {
    const std::size_t triangles = mesh.indices.size() / 3;
    if (triangles * mesh.positions.size() > kMaxTests) return false;
    const double tolerance = tolerance_of(mesh);
    const auto corner = [&](std::size_t i) { return glm::dvec3(mesh.positions[mesh.indices[i]]); };
    for (std::size_t t = 0; t < triangles; ++t) {
        const glm::dvec3 a = corner(3 * t), n = glm::cross(corner(3 * t + 1) - a, corner(3 * t + 2) - a);
        const HalfSpace plane = HalfSpace::through(a, glm::normalize(n));
        for (const std::uint32_t i : mesh.indices)
            if (!(plane.distance(glm::dvec3(mesh.positions[i])) <= tolerance)) return false;
    }
    return true;
}

std::optional<HalfSpace> transform_plane(const HalfSpace& plane, const glm::dmat4& world) {
    // Two transformed directions within the plane span the transformed plane.
    const glm::dmat3 axes = glm::dmat3(world);
    const glm::dvec3 n = plane.normal;
    const glm::dvec3 u = glm::normalize(std::abs(n.x) > 0.5 ? glm::dvec3(-n.y, n.x, 0) : glm::dvec3(0, -n.z, n.y));
    const glm::dvec3 a = axes * u, b = axes * glm::cross(n, u), normal = glm::cross(a, b);
    const double area = glm::length(normal);
    if (!(area > 1e-12 * glm::length(a) * glm::length(b)) || !std::isfinite(area)) return std::nullopt;
    return HalfSpace::through(glm::dvec3(world * glm::dvec4(-plane.offset * n, 1)), normal / area);
}

}  // namespace si
