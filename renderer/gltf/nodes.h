// The node hierarchy of one glTF scene, and the meshes, cameras, lights and instances placed in it.
#pragma once

#include "renderer/gltf/primitives.h"

namespace si::gltf {

/// Where things of the file came to lie in the scene.
struct Placed {
    std::vector<int> scene_node;                 ///< for each glTF node; -1: not in this scene
    std::vector<int> camera_nodes, light_nodes;  ///< scene node of each of the scene's cameras and lights
    std::vector<int> deformed;  ///< glTF nodes whose mesh has a skin or morph targets; they still lack their objects
};

/// Appends nodes (parents first), rigid objects, cameras and lights of glTF scene `scene_index` (-1: the default one).
Placed place_nodes(Context& context, const Json& root, const tinygltf::Model& model, Accessors& accessors,
                   Primitives& primitives, int scene_index, Scene& scene);

/// Local transform of a glTF node: its matrix, or translation * rotation * scale.
glm::dmat4 local_transform(Context& context, const tinygltf::Node& node, const Place& place);

/// KHR_lights_punctual and cameras of a node; unusable ones are left out with a warning.
void place_light(Context& context, const Json& root, const Json& node, const Place& place, const glm::dmat4& world,
                 Scene& scene);
void place_camera(Context& context, const Json& root, const Json& node, const Place& place, const glm::dmat4& world,
                  Scene& scene);

/// EXT_mesh_gpu_instancing of a node: one transform for each instance; nothing when the node has none.
std::optional<std::vector<glm::dmat4>> instance_transforms(Context& context, const Json& node, const Place& place,
                                                           Accessors& accessors, std::size_t accessor_count);

}  // namespace si::gltf
