// What is found of a scene's rigid meshes once, for as long as there are those meshes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

template <typename T>
class OfMeshes {
public:
    /// What is known of a mesh; as new where that is nothing, or of another scene's.
    T& of(const Scene& scene, std::size_t mesh) {
        if (rig_ != scene.rig || (!scene.rig && scene_ != scene.id) || meshes_.size() != scene.meshes.size()) {
            rig_ = scene.rig;
            scene_ = scene.id;
            meshes_ = std::vector<T>(scene.meshes.size());
        }
        return meshes_[mesh];
    }

private:
    std::shared_ptr<const Rig>
        rig_;                  ///< of poses that share their rigid meshes; held, so that no other takes its place
    std::uint64_t scene_ = 0;  ///< where there is none
    std::vector<T> meshes_;
};

}  // namespace si
