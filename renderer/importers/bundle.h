// Importer of bundles: the scene of another engine's frame, with its lights, camera and look-up as suggested settings.
#pragma once

#include <filesystem>

#include "renderer/gltf/gltf.h"
#include "renderer/scene/scene.h"

namespace si {

/// Loads the scene of a bundle (an engine's frame as files, docs/bundle.md): a folder, its frame.json, or a zip file.
/// The scene's suggested settings read the bundle's shadow maps (map.bundle) and place its lights. The bundle's camera
/// becomes the first camera of the scene. Warnings name everything that is unknown about the engine's shadow look-up.
/// @throws Error naming file, place and fix
Scene load_bundle(const std::filesystem::path& path, const GltfOptions& options);

}  // namespace si
