// Cache of data per rigid mesh, valid as long as the mesh exists.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/part_identity.h"

namespace si {

/// Cache of one value per mesh of a scene. A value is kept while the mesh's arrays and material stay the same, also
/// when another state of the scene is drawn.
template <typename T>
class PerMeshCache {
public:
    /// Returns the cached data of a mesh. Resets the data if the mesh's arrays or material have changed; for a deformed
    /// mesh, whenever Scene::id has changed. @param mesh index in Scene::meshes
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
