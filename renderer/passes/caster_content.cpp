#include "renderer/passes/caster_findings.h"
#include "renderer/passes/casters.h"

namespace si {
namespace {

std::uint64_t content_of(const Mesh& mesh, bool masked) {
    Key key;
    const auto add = [&](const auto& list) {
        key.add(list.size());
        if (!list.empty()) key.bytes(list.data(), list.size() * sizeof list[0]);
    };
    add(mesh.positions);
    add(mesh.indices);
    if (masked) {
        add(mesh.uv);
        add(mesh.colours);
    }
    return key.value();
}

std::uint64_t content_of(const Texture& t) {
    Key key;
    key.add(t.width).add(t.height).add(t.wrap_s).add(t.wrap_t).add(t.nearest_mag).add(t.nearest_min).add(t.mipmaps);
    return key.bytes(t.rgba.data(), t.rgba.size()).value();
}

/// Returns the content key of a mesh.
/// @param masked with the alpha mask's content
/// @param[in,out] deformed keys of deformed meshes by number, 0: not computed yet
std::uint64_t content_of_mesh(const FrameState& f, std::size_t number, bool masked,
                              std::vector<std::uint64_t>& deformed) {
    const Mesh& mesh = f.scene.meshes[number];
    std::uint64_t* known = &deformed[number];
    if (!mesh.deformer) {
        RigidMeshKeys& rigid = f.gl.caster_findings->rigid_content.of(f.scene, number);
        known = masked ? &rigid.masked : &rigid.opaque;
    }
    if (*known == 0) *known = content_of(mesh, masked);
    return *known;
}

}  // namespace

const CasterContent& caster_content(const FrameState& f) {
    CasterContentCache& known = f.gl.caster_findings->content;
    CasterContent& casters = known.casters;
    const std::uint64_t key =
        Key().add(f.geometry_key).add(f.settings.caster.blend).add(f.settings.shading.textures).value();
    if (casters.key == key) return casters;
    const Scene& scene = f.scene;
    known.textures.resize(scene.textures.size());
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        if (!known.textures[i].texture.is(scene.textures[i])) known.textures[i] = {TextureIdentity(scene.textures[i])};
    std::vector<std::uint64_t> deformed(scene.meshes.size(), 0);
    const auto& order = f.gl.scene->instance_objects();
    casters.of.assign(order.size(), 0);
    for (const Batch& batch : f.gl.scene->batches()) {
        if (!is_drawn_into_maps(f, batch)) continue;
        const bool masked = batch.masked || batch.blend;
        for (GLuint i = batch.first_instance; i < batch.first_instance + GLuint(batch.instances); ++i) {
            const Object& object = scene.objects[order[i]];
            const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
            Key content;
            content.add(content_of_mesh(f, std::size_t(object.mesh), masked, deformed));
            content.add(object.world).add(batch.cull).add(batch.mirrored).add(batch.closed).add(masked);
            if (masked && mesh.material >= 0) {
                const Material& m = scene.materials[std::size_t(mesh.material)];
                content.add(m.alpha).add(m.alpha_cutoff).add(m.base_colour.a).add(batch.texture != 0);
                if (batch.texture) {
                    std::uint64_t& of_texture = known.textures[std::size_t(m.base_colour_texture)].content;
                    if (of_texture == 0) of_texture = content_of(scene.textures[std::size_t(m.base_colour_texture)]);
                    content.add(of_texture);
                }
            }
            casters.of[i] = content.value();
        }
    }
    casters.key = key;
    return casters;
}

}  // namespace si
