// glTF 2.0 files in and out.
#pragma once

#include <filesystem>
#include <functional>

#include "renderer/scene/scene.h"

namespace si {

struct GltfOptions {
    /// Called now and then with 0..1; returning false cancels (load_gltf throws Error "cancelled").
    std::function<bool(double)> progress;
    std::size_t max_file_bytes = std::size_t{4} << 30;
    int scene = -1;  ///< which scene of the file; -1: its default
};

/// Reads a .gltf or .glb file. @throws Error naming file, place in it and remedy.
Scene load_gltf(const std::filesystem::path& path, const GltfOptions& options = {});

/// Writes a scene as one self-contained .gltf (JSON with embedded buffers) or .glb, by extension; atomically.
void save_gltf(const Scene& scene, const std::filesystem::path& path);

}  // namespace si
