#include "renderer/inspect/lost_casters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Returns true when a whole object lies before the near plane of every view, and before the light's place.
bool is_before_near(const Mesh& mesh, const glm::dmat4& world, const FittedLight& light) {
    for (const LightView& view : light.views) {
        if (view.clamps_near || view.warped()) return false;
        double farthest = -std::numeric_limits<double>::infinity();
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 at(corner & 1 ? mesh.bounds.hi.x : mesh.bounds.lo.x,
                                corner & 2 ? mesh.bounds.hi.y : mesh.bounds.lo.y,
                                corner & 4 ? mesh.bounds.hi.z : mesh.bounds.lo.z);
            const glm::dvec3 ws(world * glm::dvec4(at, 1));
            farthest = std::max(farthest, glm::dot(view.eye - ws, view.axes[2]));
        }
        const bool behind = view.curve.perspective && farthest <= 0 && light.views.size() == 1;
        if (behind || farthest >= view.curve.near) return false;
    }
    return true;
}

/// Returns true when a triangle of an object lies between a point and the light. `light` is in the object's own space.
bool is_hit(const Mesh& mesh, const glm::dvec3& point, const glm::dvec4& light) {
    const glm::dvec3 ray = light.w == 0 ? glm::dvec3(light) : glm::dvec3(light) - point;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        const glm::dvec3 ab = glm::dvec3(mesh.positions[mesh.indices[i + 1]]) - a,
                         ac = glm::dvec3(mesh.positions[mesh.indices[i + 2]]) - a;
        // Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997.
        const glm::dvec3 p = glm::cross(ray, ac), s = point - a, q = glm::cross(s, ab);
        const double det = glm::dot(ab, p);
        if (det == 0) continue;
        const double u = glm::dot(s, p) / det, v = glm::dot(ray, q) / det, t = glm::dot(ac, q) / det;
        if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && (light.w == 0 || t < 1)) return true;
    }
    return false;
}

}  // namespace

std::string_view lost_by_key(LostBy by) {
    constexpr std::string_view kKeys[] = {"culling", "near plane", "blending"};
    return kKeys[std::size_t(by)];
}

std::vector<LostCaster> lost_casters(const Scene& scene, const Settings& settings, const FittedLight& light) {
    std::vector<LostCaster> lost;
    if (!light.casts || light.views.empty()) return lost;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
        if (mesh.indices.empty() || object.ground) continue;
        const ObjectSettings& own = object_settings(scene, settings, object);
        const Cull cull = cull_in_force(own.cull, settings.caster.cull);
        if (!own.cast) continue;
        const bool blend = mesh.material >= 0 && scene.materials[std::size_t(mesh.material)].alpha == AlphaMode::Blend;
        const auto add = [&](LostBy by) { lost.push_back({int(i), by, cull, mesh.indices.size() / 3}); };
        glm::dvec4 place;
        if (blend && settings.caster.blend != BlendCasters::Mask)
            add(LostBy::Blending);
        else if (is_before_near(mesh, object.world, light))
            add(LostBy::NearPlane);
        else if (cull != Cull::None && light_in_object_space(light, object.world, place) &&
                 all_culled(mesh, place, cull))
            add(LostBy::Culling);
    }
    return lost;
}

std::vector<LostCaster> lost_casters_before(const Scene& scene, const std::vector<LostCaster>& lost,
                                            const FittedLight& light, const glm::dvec3& point_ws) {
    std::vector<LostCaster> out;
    for (const LostCaster& l : lost) {
        const Object& object = scene.objects[std::size_t(l.object)];
        glm::dvec4 place;
        if (!light_in_object_space(light, object.world, place)) continue;
        const glm::dvec3 from_origin = point_ws - glm::dvec3(object.world[3]);
        const glm::dvec3 point = glm::inverse(glm::dmat3(object.world)) * from_origin;
        if (is_hit(scene.meshes[std::size_t(object.mesh)], point, place)) out.push_back(l);
    }
    return out;
}

std::string lost_caster_text(const Scene& scene, const LostCaster& lost, int light) {
    const std::string& path = scene.nodes[std::size_t(scene.objects[std::size_t(lost.object)].node)].path;
    switch (lost.by) {
        case LostBy::NearPlane:
            return fmt::format(
                "{} casts no shadow: it lies before the near plane; light.{}.near_far=fitted or pancaking keeps it",
                path, light);
        case LostBy::Blending:
            return fmt::format("{} casts no shadow: its material blends; caster.blend=mask makes it cast", path);
        case LostBy::Culling:
            break;
    }
    return fmt::format(
        "{} casts no shadow: {}-face culling removes all of its {} triangles; object.{}.cull=none keeps them", path,
        lost.cull == Cull::Front ? "front" : "back", lost.triangles, path);
}

std::vector<std::string> lost_caster_remarks(const Scene& scene, const std::vector<LostCaster>& lost, int light,
                                             std::size_t max_lines) {
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < std::min(lost.size(), max_lines); ++i)
        notes.push_back(lost_caster_text(scene, lost[i], light));
    if (lost.size() > max_lines)
        notes.push_back(fmt::format("and {} more objects cast no shadow", lost.size() - max_lines));
    return notes;
}

}  // namespace si
