// Skins, morph targets and animations of a glTF file, converted to the scene's rig.
#pragma once

#include "renderer/gltf/nodes.h"
#include "renderer/scene/animation.h"

namespace si::gltf {

/// Adds the deformed meshes of the nodes in `placed` and the animations of a glTF file to a scene, and applies the rest
/// pose. A scene without animation gets no rig.
void add_rig(Context& context, const Json& root, const tinygltf::Model& model, Accessors& accessors,
             Primitives& primitives, const PlacedNodes& placed, Scene& scene);

/// Reads the animations of a glTF file; an invalid one is skipped with a warning.
/// @param scene_node scene node of each glTF node; -1: not in the scene
std::vector<Animation> read_animations(Context& context, const Json& root, const tinygltf::Model& model,
                                       Accessors& accessors, const std::vector<int>& scene_node);

}  // namespace si::gltf
