// Importer of the formats that Assimp reads, in a child process.
#pragma once

#include <filesystem>

#include "renderer/gltf/gltf.h"

namespace si {

/// Loads a scene from a file that Assimp reads. A child process without network and without other files than those
/// below the model's folder converts it to a GLB, which passes all checks of a glTF file.
/// @throws Error naming the file, the reason and a fix; "cancelled"
Scene load_by_assimp(const std::filesystem::path& path, const GltfOptions& options);

}  // namespace si
