// What is found of a scene's rigid meshes once, for as long as there are those meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/part_identity.h"

namespace si {

template <typename T>
class OfMeshes {
public:
    /// What is known of a mesh; as new where that is nothing, or of another.
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
    struct Known {
        MeshIdentity mesh;
        T known{};
    };
    std::uint64_t scene_ = 0;
    std::vector<Known> meshes_;
};

}  // namespace si
