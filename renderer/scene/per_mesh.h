// Cache of data per rigid mesh, valid as long as the mesh exists.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/part_identity.h"

namespace si {

/// Cache of one value per mesh of a scene. A value stays while the mesh's arrays stay the same, also in another scene
/// state.
template <typename T>
class PerMeshCache {
public:
    /// Returns the cached data of a mesh. The data is reset when the mesh's content or the scene has changed.
    T& of(const Scene& scene, std::size_t mesh) {
        if (scene_ != scene.id) {
            scene_ = scene.id;
            meshes_.resize(scene.meshes.size());
            for (std::size_t i = 0; i < meshes_.size(); ++i)
                if (const Mesh& m = scene.meshes[i]; !meshes_[i].mesh.is(scene, m))
                    meshes_[i] = {MeshIdentity(scene, m), T()};
        }
        return meshes_[mesh].known;
    }

private:
    /// Cached value of one mesh, with the identity by which a change of the mesh is noticed.
    struct Known {
        MeshIdentity mesh;
        T known{};
    };
    std::uint64_t scene_ = 0;
    std::vector<Known> meshes_;
};

}  // namespace si
