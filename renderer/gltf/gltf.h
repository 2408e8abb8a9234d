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

/// Options of load_gltf().
struct GltfOptions {
    /// Progress callback, called with 0..1; returning false cancels (load_gltf throws Error "cancelled").
    std::function<bool(double)> progress;
    std::size_t max_file_bytes = std::size_t{4} << 30;
    FileChoices file = {};  ///< scene of the file, up axis, unit
    /// Reads a file that the model names beside itself. Empty: a file below the model's folder is read.
    std::function<ReadResult(const std::string& name, std::size_t max_bytes)> read_file = {};
    /// Transform from the file's space to metres, y up, right-handed, in place of up axis and unit.
    std::optional<glm::dmat4> world = {};
};

/// Loads a scene from a .gltf or .glb file. @throws Error naming the file, the position in the file, and a fix.
Scene load_gltf(const std::filesystem::path& path, const GltfOptions& options = {});

/// Loads a scene from the bytes of a .gltf or .glb file that lies in a bundle. Files that it names are read by
/// GltfOptions::read_file, which has to be set.
/// @param path the file, for messages and Scene::name @throws Error as load_gltf()
Scene load_gltf_bytes(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                      const GltfOptions& options);

/// Loads a scene from the bytes of a GLB that an importer has made of another format. The bytes are as little trusted
/// as a file, and may name no other file. Notes, up axis and unit come from the extras of its asset.
/// @param path the user's file, for messages and Scene::name @throws Error as load_gltf()
Scene load_converted(std::span<const std::uint8_t> glb, const std::filesystem::path& path,
                     const GltfOptions& options = {});

/// Saves a scene as one self-contained file, atomically: .gltf (JSON with embedded buffers) or .glb, by extension.
/// @throws Error naming the file
void save_gltf(const Scene& scene, const std::filesystem::path& path);

/// Returns a scene as the bytes of a .glb file. @throws Error above 4 GiB
std::string glb_bytes(const Scene& scene);

/// Lists what save_gltf() bakes or drops of a scene, one sentence each: pose, skins, morph targets, animations,
/// placement, and parts of its file that the scene does not hold.
std::vector<std::string> export_notes(const Scene& scene);

}  // namespace si
