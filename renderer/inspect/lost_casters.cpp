#include "renderer/inspect/lost_casters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace si {
namespace {

/// Converts a light to an object's own space: a position (w = 1) or a direction towards the light (w = 0).
bool light_in_object_space(const FittedLight& light, const glm::dmat4& world, glm::dvec4& out) {
    // Relative to the object's origin, so that a distant scene loses no digits.
    const glm::dvec3 origin(world[3]);
    const bool parallel = !light.is_perspective();
    const glm::dvec3 from = parallel ? light.to_light : light.position - origin;
    const glm::dmat3 m(world);
    const double det = glm::determinant(m);
    if (det == 0 || !std::isfinite(det)) return false;  // flattened: no triangle has an area
    const glm::dvec3 local = glm::inverse(m) * from;
    out = glm::dvec4(local, parallel ? 0.0 : 1.0);
    return std::isfinite(glm::dot(local, local));
}

/// Returns true when every triangle of a mesh is culled. The winding in the object's own space decides: a mirroring
/// reverses both the winding and the rasteriser's front face.
bool all_culled(const Mesh& mesh, const glm::dvec4& light, Cull cull) {
    const glm::dvec3 place(light);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        const double facing = glm::dot(glm::cross(b - a, c - a), light.w == 0 ? place : place - a);
        if (cull == Cull::Front ? facing < 0 : facing > 0) return false;
    }
    return true;
}

}  // namespace

std::vector<LostCaster> lost_casters(const Scene& scene, const Settings& settings, const FittedLight& light) {
    std::vector<LostCaster> lost;
    if (!light.casts || light.views.empty()) return lost;
    if (settings.caster.cull == Cull::None && settings.objects.empty()) return lost;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
        if (mesh.indices.empty() || object.ground) continue;
        const ObjectSettings& own = object_settings(scene, settings, object);
        const Cull cull = cull_in_force(own.cull, settings.caster.cull);
        if (!own.cast || cull == Cull::None) continue;
        const bool blend = mesh.material >= 0 && scene.materials[std::size_t(mesh.material)].alpha == AlphaMode::Blend;
        if (blend && settings.caster.blend != BlendCasters::Mask) continue;
        glm::dvec4 place;
        if (!light_in_object_space(light, object.world, place)) continue;
        if (all_culled(mesh, place, cull)) lost.push_back({int(i), cull, mesh.indices.size() / 3});
    }
    return lost;
}

std::vector<std::string> lost_caster_remarks(const Scene& scene, const std::vector<LostCaster>& lost,
                                             std::size_t max_lines) {
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < std::min(lost.size(), max_lines); ++i) {
        const std::string& path = scene.nodes[std::size_t(scene.objects[std::size_t(lost[i].object)].node)].path;
        notes.push_back(fmt::format(
            "{} casts no shadow: {}-face culling removes all of its {} triangles; object.{}.cull=none keeps them", path,
            lost[i].cull == Cull::Front ? "front" : "back", lost[i].triangles, path));
    }
    if (lost.size() > max_lines)
        notes.push_back(fmt::format("and {} more objects cast no shadow likewise", lost.size() - max_lines));
    return notes;
}

}  // namespace si
