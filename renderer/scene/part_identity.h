// Identity of meshes and textures across versions of a scene: tells which results and uploads are still valid.
#pragma once

#include <tuple>

#include "renderer/scene/scene.h"

namespace si {

/// Returns the material of a mesh, or the default material if the mesh has none.
inline const Material& material_of(const Scene& scene, const Mesh& mesh) {
    static const Material kDefault;
    return mesh.material >= 0 ? scene.materials[std::size_t(mesh.material)] : kDefault;
}

/// Identity of a rigid mesh and its material at one time, to test later whether they have changed. Shares the mesh's
/// arrays, so that their addresses are not reused.
class MeshIdentity {
public:
    MeshIdentity() = default;
    MeshIdentity(const Scene& scene, const Mesh& mesh) {
        // Poses change deformed meshes in place, where nobody else holds them.
        if (mesh.deformer) return;
        mesh_ = mesh;
        material_ = material_of(scene, mesh);
        rigid_ = true;
    }

    /// Returns true when `mesh` shares all arrays with the mesh of this identity and has an equal material; false for a
    /// deformed mesh.
    bool is(const Scene& scene, const Mesh& mesh) const {
        bool shared = rigid_ && !mesh.deformer && mesh_.indices.shares_storage_with(mesh.indices);
        for_each_attribute(
            [&](auto attribute) { shared = shared && (mesh_.*attribute).shares_storage_with(mesh.*attribute); });
        return shared && material_ == material_of(scene, mesh);
    }

private:
    Mesh mesh_;
    Material material_;
    bool rigid_ = false;
};

/// Identity of a texture at one time, to test later whether it has changed. Shares the texture's pixels, so that their
/// address is not reused.
class TextureIdentity {
    static auto how(const Texture& t) {
        return std::tuple(t.width, t.height, t.srgb, t.wrap_s, t.wrap_t, t.nearest_mag, t.nearest_min, t.mipmaps);
    }

public:
    TextureIdentity() = default;
    explicit TextureIdentity(const Texture& texture) : texture_(texture), known_(true) {}

    /// Returns true when `texture` shares its pixels with the texture of this identity and is sampled in the same way.
    bool is(const Texture& texture) const {
        return known_ && texture_.rgba.shares_storage_with(texture.rgba) && how(texture_) == how(texture);
    }

private:
    Texture texture_;
    bool known_ = false;
};

}  // namespace si
