// Skins, morph targets and animations of a glTF file, converted to the scene's rig.
#pragma once

#include "renderer/gltf/nodes.h"
#include "renderer/scene/animation.h"

namespace si::gltf {

/// Adds the skinned and morphed meshes and the animations of a glTF file to a scene, and applies the rest pose. A scene
/// with neither animations nor deformed meshes gets no rig (Scene::rig).
/// @param placed nodes of the file that place_nodes() has added
void add_rig(Context& context, const Json& root, const tinygltf::Model& model, Accessors& accessors,
             Primitives& primitives, const PlacedNodes& placed, Scene& scene);

/// Reads the animations of a glTF file. Invalid animations are skipped with a warning.
/// @param scene_node index in Scene::nodes of each glTF node; -1: not in the scene
std::vector<Animation> read_animations(Context& context, const Json& root, const tinygltf::Model& model,
                                       Accessors& accessors, const std::vector<int>& scene_node);

}  // namespace si::gltf
