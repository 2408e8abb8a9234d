// Importer of bundles: the scene of another engine's frame, with its lights, camera and look-up as suggested settings.
#pragma once

#include <filesystem>

#include "renderer/gltf/gltf.h"
#include "renderer/scene/scene.h"

namespace si {

/// Loads the scene of a bundle (docs/bundle.md): a folder, its frame.json, or a zip file. Suggested settings read the
/// bundle's maps (map.bundle), and place its lights. The bundle's camera is the first of the scene. Warnings name all
/// that is unknown of the look-up. @throws Error naming file, place and fix
Scene load_bundle(const std::filesystem::path& path, const GltfOptions& options);

}  // namespace si
