// What moves in a glTF file: skins, morph targets and animations, as the scene's rig.
#pragma once

#include "renderer/gltf/nodes.h"
#include "renderer/scene/animation.h"

namespace si::gltf {

/// Adds the deformed meshes of `placed`, reads the animations and poses the scene at rest. A scene in which nothing
/// moves gets no rig.
void add_rig(Context& context, const Json& root, const tinygltf::Model& model, Accessors& accessors,
             Primitives& primitives, const Placed& placed, Scene& scene);

/// The animations of the file; one that is broken is left out with a warning.
std::vector<Animation> read_animations(Context& context, const Json& root, const tinygltf::Model& model,
                                       Accessors& accessors, const std::vector<int>& scene_node);

}  // namespace si::gltf
