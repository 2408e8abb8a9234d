#include "tests/support/traced.h"

#include "tests/support/ray_reference.h"

namespace si::test {

Receiver receiver_on(const ReferenceGeometry& geometry, std::uint32_t object, std::uint32_t primitive, double u,
                     double v, bool turned) {
    const TriangleWs t = geometry.triangle(object, primitive);
    const glm::dvec3 e1 = t[1] - t[0], e2 = t[2] - t[0], normal = glm::normalize(glm::cross(e1, e2));
    Receiver r;
    r.position_ws = t[0] + u * e1 + v * e2;
    r.normal_ws = turned ? -normal : normal;
    r.edge_m = float(std::max(glm::length(e1), glm::length(e2)));
    r.object = object;
    r.primitive = primitive;
    return r;
}

Receiver floor_receiver(const glm::dvec3& position_ws, double edge_m) {
    Receiver r;
    r.position_ws = position_ws;
    r.normal_ws = {0, 1, 0};
    r.edge_m = float(edge_m);
    r.object = 0;
    return r;
}

Receivers row_of(const std::vector<Receiver>& pixels) {
    return {int(pixels.size()), 1, {pixels.begin(), pixels.end()}};
}

SurfaceIds ids_by_rays(const Scene& scene, const Camera& camera, int width, int height) {
    const RayReference rays(scene);
    std::vector<std::uint32_t> first;  // triangle of each object in the list
    std::uint32_t count = 0;
    for (const Object& o : scene.objects) {
        first.push_back(count);
        count += std::uint32_t(scene.meshes[std::size_t(o.mesh)].indices.size() / 3);
    }
    SurfaceIds ids{width, height, {}};
    for (const auto& [x, y, origin, dir] : pixel_rays(camera, width, height)) {
        const auto hit = rays.first_hit(origin, dir);
        if (!hit) {
            ids.data.emplace_back(0, 0);
            continue;
        }
        const auto object = std::uint32_t(rays.triangle(hit->triangle).object);
        ids.data.emplace_back(object + 1, std::uint32_t(hit->triangle) - first[object]);
    }
    return ids;
}

Emitter sun(const glm::dvec3& to_light, double angular_radius_deg) {
    Emitter e;
    e.to_light = glm::normalize(to_light);
    e.size = angular_radius_deg;
    return e;
}

ReferenceQuery query_for(const Scene& scene, const Emitter& emitter, const ReferenceOptions& options) {
    return {emitter, object_traits(scene, Settings{}), {}, {}, options};
}

std::shared_ptr<const ReferenceGeometry> geometry_of(const Scene& scene, const Settings& settings) {
    return std::make_shared<ReferenceGeometry>(scene, settings);
}

}  // namespace si::test
