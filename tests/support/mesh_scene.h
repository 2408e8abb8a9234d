// Scenes of one mesh.
#pragma once

#include <utility>

#include "renderer/scenes/shapes.h"

namespace si {

/// Makes a finalised scene of one grey mesh; its node has the mesh's name.
inline Scene make_scene(Mesh mesh, const glm::dmat4& local = glm::dmat4(1)) {
    Scene scene = named_scene(mesh.name, "");
    add_shape(scene, scene.name, -1, std::move(mesh), add_material(scene, "Grey", glm::vec3(0.6f)), local);
    return finished(std::move(scene));
}

}  // namespace si
