#include "renderer/reference/first_surface.h"

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

}  // namespace si
