// Node hierarchy of one glTF scene, with the meshes, cameras, lights and instances that its nodes place.
#pragma once

#include "renderer/gltf/primitives.h"

namespace si::gltf {

/// Indices of the scene's nodes, cameras and lights that place_nodes() made from the nodes of a glTF file.
struct PlacedNodes {
    std::vector<int> scene_node;                 ///< scene node of each glTF node; -1: not in this scene
    std::vector<int> camera_nodes, light_nodes;  ///< scene node of each of the scene's cameras and lights
    std::vector<int> deformed;  ///< glTF nodes whose mesh has a skin or morph targets; add_rig() adds their objects
};

/// Adds the nodes of a glTF scene to `scene`, parents first, with their rigid objects, cameras and lights. add_rig()
/// adds the skinned and morphed objects later.
/// @param root JSON of the file @param model the same file as parsed by tinygltf
/// @param scene_index index of the scene in the file; -1: the file's default scene
PlacedNodes place_nodes(Context& context, const Json& root, const tinygltf::Model& model, Accessors& accessors,
                        Primitives& primitives, int scene_index, Scene& scene);

/// Returns the local transform of a glTF node: its matrix, or translation * rotation * scale. An invalid rotation is
/// ignored or normalised, with a warning. @param place position in the JSON, for warnings
glm::dmat4 local_transform(Context& context, const tinygltf::Node& node, const Place& place);

/// Adds the light of a glTF node (KHR_lights_punctual) to `scene`; does nothing for a node without light. An unusable
/// light is skipped with a warning.
/// @param node JSON of the node @param place position in the JSON, for warnings @param world transform from node to
/// world
void place_light(Context& context, const Json& root, const Json& node, const Place& place, const glm::dmat4& world,
                 Scene& scene);
/// Adds the camera of a glTF node to `scene`; does nothing for a node without camera. An unusable camera is skipped
/// with a warning.
/// @param node JSON of the node @param place position in the JSON, for warnings @param world transform from node to
/// world
void place_camera(Context& context, const Json& root, const Json& node, const Place& place, const glm::dmat4& world,
                  Scene& scene);

/// Reads the transforms of all instances of a glTF node (EXT_mesh_gpu_instancing); nullopt for a node without
/// instances.
/// @param place position in the JSON, for errors @param accessor_count number of accessors in the file @throws Error
std::optional<std::vector<glm::dmat4>> instance_transforms(Context& context, const Json& node, const Place& place,
                                                           Accessors& accessors, std::size_t accessor_count);

}  // namespace si::gltf
