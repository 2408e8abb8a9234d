// Loading and saving of glTF 2.0 files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/base/regular_file.h"
#include "renderer/scene/scene.h"

namespace si {

/// Options for loading a glTF file: progress callback, size limit, up axis and unit, and access to the files that it
/// names.
struct GltfOptions {
    /// Progress callback, called with 0..1; returning false cancels (load_gltf throws Error "cancelled").
    std::function<bool(double)> progress;
    /// Largest size in bytes of the model file, and largest total size of the other files that it loads.
    std::size_t max_file_bytes = std::size_t{4} << 30;
    FileChoices file = {};  ///< the user's choices: scene of the file, up axis, unit
    /// Callback that reads a buffer or image file which the model names. Empty: the loader reads such files itself,
    /// from the model's folder and below.
    std::function<ReadResult(const std::string& name, std::size_t max_bytes)> read_file = {};
    /// Transform from the file's space to the scene's: metres, y up, right-handed. If set, it replaces the chosen up
    /// axis and unit.
    std::optional<glm::dmat4> world = {};
};

/// Loads a scene from a .gltf or .glb file. @throws Error naming the file, the position in the file, and a fix.
Scene load_gltf(const std::filesystem::path& path, const GltfOptions& options = {});

/// Loads a scene from the bytes of a .gltf or .glb file in a bundle (one frame of an engine as files). Buffers and
/// images that the bytes name are read by GltfOptions::read_file, which must be set.
/// @param path path of the .gltf or .glb file, for messages and Scene::name @throws Error as load_gltf()
Scene load_gltf_bytes(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                      const GltfOptions& options);

/// Loads a scene from the bytes of a GLB that an importer has made from a file of another format. The bytes are
/// validated like a file, and must not name other files. Notes, up axis and unit come from the extras of the GLB's
/// asset.
/// @param path the user's file, for messages and Scene::name @throws Error as load_gltf()
Scene load_converted(std::span<const std::uint8_t> glb, const std::filesystem::path& path,
                     const GltfOptions& options = {});

/// Saves a scene as one self-contained file. The file's extension chooses .gltf (JSON with embedded buffers) or .glb.
/// Writes atomically: an error leaves an earlier file unchanged.
/// @throws Error naming the file
void save_gltf(const Scene& scene, const std::filesystem::path& path);

/// Returns a scene as the bytes of a .glb file (binary glTF). @throws Error above 4 GiB
std::string glb_bytes(const Scene& scene);

/// Lists the parts of a scene that save_gltf() bakes into vertices and nodes or drops, one sentence each. These are
/// pose, skins, morph targets, animations, placement, and parts of the loaded file that Scene does not hold.
std::vector<std::string> export_notes(const Scene& scene);

}  // namespace si
