#include "renderer/reference/first_surface.h"

#include <algorithm>
#include <limits>

#include "renderer/reference/reference_rays.h"

namespace si {

std::vector<double> first_caster_distances(const ReferenceScene& scene, std::span<const LightRaySegment> segments) {
    std::vector<double> out;
    std::vector<Hit> hits;
    for (const LightRaySegment& way : segments) {
        const glm::dvec3 from = scene.impl().to_unit(way.from_ws), to = scene.impl().to_unit(way.to_ws);
        const double metres = glm::length(way.to_ws - way.from_ws);
        double first = std::numeric_limits<double>::quiet_NaN();
        if (metres > 0) {
            collect_hits(scene.impl(), make_ray(glm::vec3(from), glm::vec3(to - from), 1, 0), {}, hits);
            for (const Hit& hit : hits)
                if (!(hit.t * metres >= first)) first = hit.t * metres;
        }
        out.push_back(first);
    }
    return out;
}

std::vector<std::optional<FirstCaster>> first_casters(const ReferenceScene& scene,
                                                      std::span<const LightRaySegment> segments,
                                                      std::span<const ObjectTraits> traits, const Workers& workers) {
    constexpr std::size_t kBlock = 1024;
    std::vector<std::optional<FirstCaster>> out(segments.size());
    parallel_for_blocks((segments.size() + kBlock - 1) / kBlock, workers, [&](std::size_t block) {
        std::vector<Hit> hits;
        for (std::size_t i = block * kBlock; i < std::min((block + 1) * kBlock, segments.size()); ++i) {
            // From the far end, as culling takes the direction towards the light.
            const glm::dvec3 from = scene.impl().to_unit(segments[i].to_ws),
                             to = scene.impl().to_unit(segments[i].from_ws);
            const double metres = glm::length(segments[i].to_ws - segments[i].from_ws);
            if (!(metres > 0)) continue;
            collect_hits(scene.impl(), make_ray(glm::vec3(from), glm::vec3(to - from), 1, 0),
                         {.culls = traits, .exact = {}}, hits);
            const Hit* first = nullptr;
            for (const Hit& hit : hits)
                if (!hit.culled && (!first || hit.t > first->t)) first = &hit;
            if (!first) continue;
            const TriangleWs t = scene.geometry().triangle(first->object, first->primitive);
            const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
            const double length = glm::length(normal);
            out[i] = FirstCaster{(1 - double(first->t)) * metres, first->object,
                                 length > 0 ? normal / length : glm::dvec3(0)};
        }
    });
    return out;
}

}  // namespace si
