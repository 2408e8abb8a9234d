// Whether what was found of a mesh or a texture, or handed to the driver, still holds after its scene has changed.
#pragma once

#include <tuple>

#include "renderer/scene/scene.h"

namespace si {

/// The material of a mesh, or the default one.
inline const Material& material_of(const Scene& scene, const Mesh& mesh) {
    static const Material kDefault;
    return mesh.material >= 0 ? scene.materials[std::size_t(mesh.material)] : kDefault;
}

/// A rigid mesh as it was. Its arrays are held, so that no others take their place in memory.
class SameMesh {
public:
    SameMesh() = default;
    SameMesh(const Scene& scene, const Mesh& mesh) {
        // Poses change deformed meshes in place, where nobody else holds them.
        if (mesh.deformer) return;
        mesh_ = mesh;
        material_ = material_of(scene, mesh);
        rigid_ = true;
    }

    /// Whether it is this one: the same arrays in memory and an equal material. A deformed one never is.
    bool is(const Scene& scene, const Mesh& mesh) const {
        return rigid_ && !mesh.deformer && mesh_.positions.shares(mesh.positions) &&
               mesh_.normals.shares(mesh.normals) && mesh_.uv.shares(mesh.uv) &&
               mesh_.uv_normal.shares(mesh.uv_normal) && mesh_.tangents.shares(mesh.tangents) &&
               mesh_.colours.shares(mesh.colours) && mesh_.indices.shares(mesh.indices) &&
               material_ == material_of(scene, mesh);
    }

private:
    Mesh mesh_;
    Material material_;
    bool rigid_ = false;
};

/// A texture as it was. Its pixels are held likewise.
class SameTexture {
    static auto how(const Texture& t) {
        return std::tuple(t.width, t.height, t.srgb, t.wrap_s, t.wrap_t, t.nearest_mag, t.nearest_min, t.mipmaps);
    }

public:
    SameTexture() = default;
    explicit SameTexture(const Texture& texture) : texture_(texture), known_(true) {}

    /// Whether it is this one: the same pixels in memory, looked up in the same way.
    bool is(const Texture& texture) const {
        return known_ && texture_.rgba.shares(texture.rgba) && how(texture_) == how(texture);
    }

private:
    Texture texture_;
    bool known_ = false;
};

}  // namespace si
