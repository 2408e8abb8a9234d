// Importer of the formats that Assimp reads, in a child process.
#pragma once

#include <filesystem>

#include "renderer/gltf/gltf.h"

namespace si {

/// Loads a scene from a model file in any format that Assimp reads. A child process converts the file to a GLB, without
/// network and without files outside the model's folder. The GLB is then validated like a glTF file.
/// @throws Error naming the file, the reason and a fix; "cancelled"
Scene load_by_assimp(const std::filesystem::path& path, const GltfOptions& options);

}  // namespace si
