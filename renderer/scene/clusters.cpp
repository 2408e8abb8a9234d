#include "renderer/scene/clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/base/directions.h"

namespace si {
namespace {

constexpr std::size_t kLeastTriangles = 256;    ///< smaller meshes are one cluster
constexpr std::size_t kTrianglesACluster = 32;  ///< approximate
constexpr double kMostCells = 2048;

/// Returns the numbers of grid cells along each axis: nearly cubic cells, about `cells` in all.
glm::ivec3 divided(const glm::dvec3& size, double cells) {
    const auto along = [&](double side) { return glm::max(glm::ceil(size / side), glm::dvec3(1)); };
    double side = std::max({size.x, size.y, size.z});
    if (!(side > 0)) return glm::ivec3(1);
    for (glm::dvec3 n = along(side); n.x * n.y * n.z < cells; n = along(side)) side *= 0.9;
    return glm::ivec3(along(side));
}

/// Sine of the safety margin of facing tests, for float rounding of normals and positions in the driver.
constexpr double kClear = 1e-2;

}  // namespace

VisibleSide visible_side(const Cluster& cluster, const glm::dvec4& from) {
    if (cluster.axis == glm::dvec3(0)) return VisibleSide::Either;
    const glm::dvec3 there = glm::dvec3(from) - from.w * cluster.box.centre();
    const double distance = glm::length(there), radius = from.w * cluster.box.radius();
    const double off = cluster.spread + kClear;  // largest angle between a normal and the axis
    constexpr double kRightAngle = 0.5 * std::numbers::pi;
    // Least elevation of the viewer above the plane across the axis, for all normals and positions.
    const double least = distance > radius ? off + std::asin(radius / distance) : kRightAngle;
    if (least < kRightAngle) {
        const double cosine = glm::dot(cluster.axis, there) / distance;
        if (cosine > std::sin(least)) return VisibleSide::Front;
        if (cosine < -std::sin(least)) return VisibleSide::Back;
    }
    // Close to a flat cluster its box decides little, but the height above all corners does: for a normal n at most
    // `off` from the axis, n.v is at least cos(off) axis.v - sin(off) |v|.
    if (!(off < kRightAngle)) return VisibleSide::Either;
    const double along = glm::dot(cluster.axis, glm::dvec3(from)), aside = std::tan(off) * (distance + radius);
    if (along - from.w * cluster.highest > aside) return VisibleSide::Front;
    return from.w * cluster.lowest - along > aside ? VisibleSide::Back : VisibleSide::Either;
}

std::vector<Cluster> build_clusters(const Mesh& mesh) {
    const std::size_t triangles = mesh.indices.size() / 3;
    if (triangles == 0 || mesh.bounds.empty()) return {{mesh.bounds}};
    const glm::dvec3 size = mesh.bounds.hi - mesh.bounds.lo;
    const double wanted =
        triangles < kLeastTriangles ? 1 : std::min(double(triangles) / kTrianglesACluster, kMostCells);
    const glm::ivec3 cells = divided(size, wanted);
    const glm::dvec3 per_m = glm::dvec3(cells) / glm::max(size, glm::dvec3(1e-300));
    std::vector<Cluster> all(std::size_t(cells.x) * std::size_t(cells.y) * std::size_t(cells.z));
    const auto each_triangle = [&](auto&& add) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::dvec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                             c = mesh.positions[mesh.indices[i + 2]];
            const glm::dvec3 at = ((a + b + c) / 3.0 - mesh.bounds.lo) * per_m;
            const glm::ivec3 cell =
                glm::clamp(glm::ivec3(glm::clamp(at, glm::dvec3(0), glm::dvec3(1e6))), glm::ivec3(0), cells - 1);
            add(all[(std::size_t(cell.z) * std::size_t(cells.y) + std::size_t(cell.y)) * std::size_t(cells.x) +
                    std::size_t(cell.x)],
                a, b, c);
        }
    };
    each_triangle([](Cluster& to, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        to.box.add(a);
        to.box.add(b);
        to.box.add(c);
        to.axis += unit_normal(a, b, c);
    });
    std::vector<double> least(all.size(), 1);  // cosines to the axis
    for (Cluster& c : all) c.axis = glm::length(c.axis) > 0 ? glm::normalize(c.axis) : glm::dvec3(0);
    for (Cluster& c : all) {
        c.lowest = std::numeric_limits<double>::infinity();
        c.highest = -c.lowest;
    }
    each_triangle([&](Cluster& to, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        double& cosine = least[std::size_t(&to - all.data())];
        cosine = std::min(cosine, glm::dot(to.axis, unit_normal(a, b, c)));
        const auto [low, high] = std::minmax({glm::dot(to.axis, a), glm::dot(to.axis, b), glm::dot(to.axis, c)});
        to.lowest = std::min(to.lowest, low);
        to.highest = std::max(to.highest, high);
    });
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!(least[i] > 0)) all[i].axis = glm::dvec3(0);
        all[i].spread = std::acos(std::clamp(least[i], -1.0, 1.0));
    }
    std::erase_if(all, [](const Cluster& c) { return c.box.empty(); });
    return all;
}

std::vector<Bounds> index_run_boxes(const Mesh& mesh) {
    std::vector<Bounds> out;
    if (mesh.indices.size() < 2 * kRunIndices) return out;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        if (i % kRunIndices == 0) out.emplace_back();
        out.back().add(glm::dvec3(mesh.positions[mesh.indices[i]]));
    }
    return out;
}

}  // namespace si
