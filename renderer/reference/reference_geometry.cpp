#include "renderer/reference/reference_geometry.h"

#include <cmath>
#include <map>

#include "renderer/scene/part_identity.h"

namespace si {
namespace {

bool blend_casts(const Settings& settings) {
    return settings.caster.blend == BlendCasters::Mask;
}

/// Converter of scene meshes and textures for ray tracing; each is converted once.
class Copier {
public:
    Copier(const Scene& scene, const Settings& settings) : scene_(scene), settings_(settings) {}

    std::shared_ptr<const ReferenceMesh> mesh(int index) {
        auto& copy = meshes_[index];
        if (copy) return copy;
        const Mesh& from = scene_.meshes[std::size_t(index)];
        const Material& material = material_of(scene_, from);
        auto to = std::make_shared<ReferenceMesh>();
        to->positions = from.positions;
        to->normals = from.normals;
        to->indices = from.indices;
        // Cutoffs of the light's depth pass; blended surfaces have a cutoff only there.
        if (material.alpha == AlphaMode::Mask)
            to->mask = mask(from, material, material.alpha_cutoff);
        else if (material.alpha == AlphaMode::Blend && blend_casts(settings_))
            to->mask = mask(from, material, 0.5);
        return copy = std::move(to);
    }

private:
    const Scene& scene_;
    const Settings& settings_;
    std::map<int, std::shared_ptr<const ReferenceMesh>> meshes_;
    std::map<int, std::shared_ptr<const AlphaTexture>> textures_;

    std::unique_ptr<const AlphaMask> mask(const Mesh& mesh, const Material& material, double cutoff) {
        std::shared_ptr<const AlphaTexture> texture;
        if (const int index = material.base_colour_texture; index >= 0) {
            const Texture& from = scene_.textures[std::size_t(index)];
            auto& copy = textures_[index];
            if (!copy && !from.rgba.empty()) copy = std::make_shared<AlphaTexture>(from);
            texture = copy;
        }
        return std::make_unique<AlphaMask>(mesh, material, cutoff, std::move(texture));
    }
};

}  // namespace

ReferenceGeometry::ReferenceGeometry(const Scene& scene, const Settings& settings)
    : bounds(scene.bounds), centre(main_bounds(scene).centre()), key(reference_geometry_key(scene, settings).value()) {
    Copier copier(scene, settings);
    objects.reserve(scene.objects.size());
    for (const Object& object : scene.objects) {
        const Material& material = material_of(scene, scene.meshes[std::size_t(object.mesh)]);
        const bool transparent = material.alpha == AlphaMode::Blend && !blend_casts(settings);
        const bool casts = !object.ground && !transparent && object_settings(scene, settings, object).cast;
        objects.push_back(
            {copier.mesh(object.mesh), object.world, casts, object.ground, scene.nodes[std::size_t(object.node)].path});
    }
}

std::size_t ReferenceGeometry::caster_triangles() const {
    std::size_t count = 0;
    for (const ReferenceObject& o : objects) count += o.casts ? o.mesh->triangles() : 0;
    return count;
}

UnitFrame ReferenceGeometry::unit_frame() const {
    UnitFrame frame;
    if (!bounds.empty()) frame.centre = centre;
    if (const double radius = bounds.radius(); radius > 0) frame.scale = std::exp2(-std::ilogb(radius));
    return frame;
}

void ReferenceGeometry::add_content(Key& to) const {
    std::map<const ReferenceMesh*, std::size_t> numbers;
    to.add(objects.size()).add(bounds.lo).add(bounds.hi);
    for (const ReferenceObject& o : objects) {
        const auto [known, first] = numbers.emplace(o.mesh.get(), numbers.size());
        to.add(known->second).add(o.world).add(o.casts);
        if (!first) continue;
        const ReferenceMesh& m = *o.mesh;
        to.add(m.positions.size()).bytes(m.positions.data(), m.positions.size() * sizeof(m.positions[0]));
        to.add(m.indices.size()).bytes(m.indices.data(), m.indices.size() * sizeof(m.indices[0]));
        to.add(m.mask != nullptr);
        if (m.mask) m.mask->add_content(to);
    }
}

TriangleWs ReferenceGeometry::triangle(std::uint32_t object, std::uint32_t primitive) const {
    const ReferenceObject& o = objects[object];
    const std::uint32_t* i = &o.mesh->indices[3 * std::size_t(primitive)];
    const auto corner = [&](std::uint32_t k) {
        return glm::dvec3(o.world * glm::dvec4(glm::dvec3(o.mesh->positions[k]), 1));
    };
    return {corner(i[0]), corner(i[1]), corner(i[2])};
}

glm::dvec3 ReferenceGeometry::smooth_normal(std::uint32_t object, std::uint32_t primitive,
                                            const glm::dvec3& position_ws) const {
    const ReferenceObject& o = objects[object];
    if (o.mesh->normals.empty()) return glm::dvec3(0);
    const TriangleWs t = triangle(object, primitive);
    const glm::dvec3 e1 = t[1] - t[0], e2 = t[2] - t[0], p = position_ws - t[0], n = glm::cross(e1, e2);
    const double u = glm::dot(glm::cross(p, e2), n) / glm::dot(n, n);
    const double v = glm::dot(glm::cross(e1, p), n) / glm::dot(n, n);
    const std::uint32_t* i = &o.mesh->indices[3 * std::size_t(primitive)];
    const auto corner = [&](std::uint32_t k) { return glm::dvec3(o.mesh->normals[k]); };
    const glm::dvec3 local = (1 - u - v) * corner(i[0]) + u * corner(i[1]) + v * corner(i[2]);
    // Cofactors need no inverse, which a scale of 0 lacks.
    const glm::dmat3 m(o.world);
    const glm::dvec3 normal =
        local.x * glm::cross(m[1], m[2]) + local.y * glm::cross(m[2], m[0]) + local.z * glm::cross(m[0], m[1]);
    const double length = glm::length(normal);
    return length > 0 && std::isfinite(length) ? normal / length : glm::dvec3(0);
}

Key reference_geometry_key(const Scene& scene, const Settings& settings) {
    Key key;
    key.add(scene.id).add(blend_casts(settings));
    for (const auto& [path, object] : settings.objects)
        if (!object.cast) key.add(path);
    return key;
}

std::vector<ObjectTraits> object_traits(const Scene& scene, const Settings& settings) {
    std::vector<ObjectTraits> traits(scene.objects.size());
    for (std::size_t i = 0; i < traits.size(); ++i) {
        const ObjectSettings& own = object_settings(scene, settings, scene.objects[i]);
        traits[i].receives = own.receive;
        traits[i].cull = cull_in_force(own.cull, settings.caster.cull);
    }
    return traits;
}

}  // namespace si
