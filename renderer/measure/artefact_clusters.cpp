#include "renderer/measure/artefact_clusters.h"

#include <algorithm>
#include <functional>

namespace si {
namespace {

ArtefactCluster cluster_of(const std::vector<glm::ivec2>& members) {
    ArtefactCluster c{.first = members.front(), .last = members.front(), .pixels = members.size()};
    glm::dvec2 mean(0);
    for (const glm::ivec2 p : members) {
        mean += glm::dvec2(p) / double(members.size());
        c.first = glm::min(c.first, p);
        c.last = glm::max(c.last, p);
    }
    const auto off = [&](glm::ivec2 p) {
        const glm::dvec2 d = glm::dvec2(p) - mean;
        return glm::dot(d, d);
    };
    c.pixel = *std::ranges::min_element(members, {}, off);
    return c;
}

}  // namespace

std::vector<ArtefactCluster> artefact_clusters(const std::vector<ClassifiedPixel>& classified, int width,
                                               Artefact cause, std::size_t max_clusters) {
    std::vector<ArtefactCluster> out;
    const int height = width > 0 ? int(classified.size() / std::size_t(width)) : 0;
    const auto index = [&](glm::ivec2 p) { return std::size_t(p.y) * std::size_t(width) + std::size_t(p.x); };
    std::vector<bool> taken(classified.size(), false);
    const auto takes = [&](glm::ivec2 p) {
        if (p.x < 0 || p.y < 0 || p.x >= width || p.y >= height) return false;
        if (classified[index(p)].artefact != cause || taken[index(p)]) return false;
        taken[index(p)] = true;
        return true;
    };
    std::vector<glm::ivec2> members;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (!takes({x, y})) continue;
            members.assign(1, {x, y});
            for (std::size_t next = 0; next < members.size(); ++next)
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx)
                        if (const glm::ivec2 p = members[next] + glm::ivec2(dx, dy); takes(p)) members.push_back(p);
            out.push_back(cluster_of(members));
        }
    std::ranges::stable_sort(out, std::greater{}, &ArtefactCluster::pixels);
    if (out.size() > max_clusters) out.resize(max_clusters);
    return out;
}

}  // namespace si
