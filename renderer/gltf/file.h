// Safe file access for the glTF loader: regular files only, of limited size, inside the model's folder.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace si::gltf {

/// Owned block of bytes without initialisation.
struct Bytes {
    /// Deleter for malloc() memory.
    struct Free {
        void operator()(std::uint8_t* bytes) const { std::free(bytes); }
    };
    std::unique_ptr<std::uint8_t[], Free> data;
    std::size_t size = 0;
    Bytes() = default;
    /// Allocates `size` bytes, in huge pages for large blocks: page faults of 4 KiB pages take as long as reading the
    /// file. @throws std::bad_alloc
    explicit Bytes(std::size_t size);
    /// Returns the bytes of the block.
    std::span<const std::uint8_t> span() const { return {data.get(), size}; }
};

/// Bytes of a file or data URI, or the reason why they could not be read.
struct ReadResult {
    Bytes bytes;
    std::string error;  ///< empty: success; otherwise the reason, for people
};

/// Reads a whole regular file; never blocks on a pipe or device. Errors are returned, not thrown.
/// @param max_bytes larger files are an error @param progress called with 0..1 between blocks; may throw
ReadResult read_regular_file(const std::filesystem::path& path, std::size_t max_bytes,
                             const std::function<void(double)>& progress = {});

/// Returns true for "data:" URIs, which contain their bytes.
bool is_data_uri(std::string_view uri);

/// Decodes the bytes of a base64 data URI (RFC 2397, RFC 4648; padding optional, otherwise strict).
ReadResult decode_data_uri(std::string_view uri);

/// File that a URI names, or the reason why it is not allowed.
struct ResolvedUri {
    std::filesystem::path path;
    std::string error;  ///< empty: resolved
};

/// Resolves a relative URI (RFC 3986, percent-encoded) to a file below `folder`. Anything outside the folder, or on the
/// network, is an error.
ResolvedUri resolve_uri(const std::filesystem::path& folder, std::string_view uri);

}  // namespace si::gltf
