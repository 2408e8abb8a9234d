#include "renderer/scene/face_normals.h"

#include <array>
#include <numeric>

#include "renderer/base/directions.h"

namespace si {
namespace {

/// Assumed size of the driver's vertex cache. A vertex outside it is shaded again, so that a copy costs nothing.
constexpr std::uint32_t kRemembered = 64;

}  // namespace

FlatNormalMesh face_normals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    FlatNormalMesh out;
    out.indices.reserve(indices.size());
    out.normals.assign(positions.size(), glm::vec3(0));
    std::vector<bool> taken(positions.size());            // by vertex, copies included: carries a normal
    std::vector<std::uint32_t> shaded(positions.size());  // shading order number; 0: not shaded yet
    std::vector<std::uint32_t> latest(positions.size());  // latest copy of a vertex, or itself
    std::iota(latest.begin(), latest.end(), 0u);
    std::uint32_t count = kRemembered;
    const auto remembered = [&](std::uint32_t v) { return shaded[v] != 0 && count - shaded[v] < kRemembered; };
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> corners{indices[i], indices[i + 1], indices[i + 2]};
        const glm::vec3 n = unit_normal(positions[corners[0]], positions[corners[1]], positions[corners[2]]);
        // Preferred corner: one with this normal, else a free one, else one that would be shaded again anyway.
        std::size_t best = 0;
        int best_rank = -1;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = latest[corners[k]];
            const int rank = taken[v] && out.normals[v] == n ? 3 : !taken[v] ? 2 : !remembered(v) ? 1 : 0;
            if (rank > best_rank) {
                best_rank = rank;
                best = k;
            }
        }
        if (best_rank < 2) {
            latest[corners[best]] = std::uint32_t(out.normals.size());
            out.copies.push_back(corners[best]);
            out.normals.emplace_back();
            taken.push_back(false);
            shaded.push_back(0);
        }
        const std::uint32_t carrier = latest[corners[best]];
        taken[carrier] = true;
        out.normals[carrier] = n;
        for (const std::size_t k : {best + 1, best + 2, best}) {
            const std::uint32_t v = latest[corners[k % 3]];
            out.indices.push_back(v);
            if (!remembered(v)) shaded[v] = ++count;
        }
    }
    return out;
}

}  // namespace si
