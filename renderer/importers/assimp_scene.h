// Conversion of a model that Assimp has read to a GLB.
#pragma once

#include <assimp/scene.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/importers/assimp_files.h"

namespace si::assimp {

/// Facts about a model file that the conversion to a GLB needs besides Assimp's scene.
struct Source {
    std::string label;               ///< name of the format: "OBJ"
    std::string extension;           ///< extension of the model's file, lower case, with the dot
    ModelFolder& folder;             ///< folder of the model, with its textures
    std::vector<std::string> notes;  ///< remarks from reading, for people
};

/// Converts a model that Assimp has read to the bytes of a GLB: triangles in their rest pose, hierarchy, base colours,
/// masks, normal maps, cameras and lights. Root nodes turn the file's up axis upwards and scale its unit to metres. The
/// extras of the asset hold notes about everything that is left out, the up axis, the unit and the names of all files
/// that the model needs (renderer/gltf/extras.h reads them).
/// @throws Error when the model cannot be converted
std::vector<std::uint8_t> to_glb(const aiScene& scene, const Source& source);

}  // namespace si::assimp
