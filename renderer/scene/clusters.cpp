#include "renderer/scene/clusters.h"

#include <algorithm>
#include <cmath>

namespace si {
namespace {

constexpr std::size_t kLeastTriangles = 256;    ///< of a mesh that is worth dividing
constexpr std::size_t kTrianglesACluster = 32;  ///< about
constexpr double kMostCells = 2048;

/// Cells along each axis, about as long as they are wide, and so many in all.
glm::ivec3 divided(const glm::dvec3& size, double cells) {
    const auto along = [&](double side) { return glm::max(glm::ceil(size / side), glm::dvec3(1)); };
    double side = std::max({size.x, size.y, size.z});
    if (!(side > 0)) return glm::ivec3(1);
    for (glm::dvec3 n = along(side); n.x * n.y * n.z < cells; n = along(side)) side *= 0.9;
    return glm::ivec3(along(side));
}

}  // namespace

std::vector<Bounds> clusters_of(const Mesh& mesh) {
    const std::size_t triangles = mesh.indices.size() / 3;
    if (triangles < kLeastTriangles || mesh.bounds.empty()) return {mesh.bounds};
    const glm::dvec3 size = mesh.bounds.hi - mesh.bounds.lo;
    const glm::ivec3 cells = divided(size, std::min(double(triangles) / kTrianglesACluster, kMostCells));
    const glm::dvec3 per_m = glm::dvec3(cells) / glm::max(size, glm::dvec3(1e-300));
    std::vector<Bounds> all(std::size_t(cells.x) * std::size_t(cells.y) * std::size_t(cells.z));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                         c = mesh.positions[mesh.indices[i + 2]];
        const glm::dvec3 at = ((a + b + c) / 3.0 - mesh.bounds.lo) * per_m;
        const glm::ivec3 cell =
            glm::clamp(glm::ivec3(glm::clamp(at, glm::dvec3(0), glm::dvec3(1e6))), glm::ivec3(0), cells - 1);
        Bounds& box = all[(std::size_t(cell.z) * std::size_t(cells.y) + std::size_t(cell.y)) * std::size_t(cells.x) +
                          std::size_t(cell.x)];
        box.add(a), box.add(b), box.add(c);
    }
    std::erase_if(all, [](const Bounds& box) { return box.empty(); });
    return all;
}

std::vector<Bounds> run_boxes_of(const Mesh& mesh) {
    std::vector<Bounds> out;
    if (mesh.indices.size() < 2 * kRunIndices) return out;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        if (i % kRunIndices == 0) out.emplace_back();
        out.back().add(glm::dvec3(mesh.positions[mesh.indices[i]]));
    }
    return out;
}

}  // namespace si
