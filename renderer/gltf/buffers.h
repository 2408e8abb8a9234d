// Buffers of a glTF file: loaded on first use, from the GLB chunk, a data URI or a file in the model's folder.
#pragma once

#include <span>
#include <vector>

#include "renderer/gltf/container.h"
#include "renderer/gltf/file.h"
#include "renderer/gltf/json_guard.h"

namespace si::gltf {

/// Buffers and buffer views of one glTF file. Buffers are loaded on first use, and their total size is limited.
class Buffers {
public:
    /// Prepares the buffers of a glTF file, without loading any. `context`, `root`, `container` and its bytes must
    /// outlive this object.
    Buffers(Context& context, const Json& root, const Container& container);
    /// Returns the bytes of glTF buffer `i`; loads them on first use. @throws Error when they cannot be loaded.
    std::span<const std::uint8_t> buffer(std::size_t i);
    /// Returns the bytes of glTF buffer view `i`, and loads its buffer on first use. Call after check_data(), which
    /// validates all views. Empty for a faulty view, which no accessor reads.
    /// @throws Error when the buffer cannot be loaded
    std::span<const std::uint8_t> view(std::size_t i);
    /// Appends a buffer of decoded bytes, such as decompressed vertices. Its index is the previous number of buffers.
    /// The caller adds the same buffer to the JSON document.
    void add(std::vector<std::uint8_t> bytes);
    /// Returns the part of GltfOptions::max_file_bytes, in bytes, that is left for further files and decoded buffers.
    std::size_t bytes_left() const { return bytes_left_; }
    /// Returns the total size in bytes of all buffers loaded or added so far.
    std::size_t bytes_loaded() const { return bytes_loaded_; }
    /// Subtracts `bytes` from bytes_left(), at most to 0. Call after an image was read from a file or data URI.
    void spend(std::size_t bytes) { bytes_left_ -= std::min(bytes, bytes_left_); }

private:
    /// Loads the bytes of a glTF buffer from a data URI or a file.
    /// @param buffer JSON of the buffer @param place position in the JSON, for errors @throws Error
    Bytes load(const Json& buffer, const Place& place);

    Context& context_;
    const Json& root_;
    const Container& container_;
    std::vector<Bytes> loaded_;
    std::vector<std::vector<std::uint8_t>> decoded_;
    std::vector<std::span<const std::uint8_t>> spans_;
    std::size_t bytes_left_ = 0, bytes_loaded_ = 0;
};

}  // namespace si::gltf
