// Bytes from the disk: regular files only, bounded, below the model's own folder.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace si::gltf {

/// A block of bytes that is not zeroed before it is filled.
struct Bytes {
    struct Free {
        void operator()(std::uint8_t* bytes) const { std::free(bytes); }
    };
    std::unique_ptr<std::uint8_t[], Free> data;
    std::size_t size = 0;
    Bytes() = default;
    /// Large blocks lie in huge pages where the system has them: to be given page after page of 4 KiB takes as long as
    /// reading the file into them. @throws std::bad_alloc
    explicit Bytes(std::size_t size);
    std::span<const std::uint8_t> span() const { return {data.get(), size}; }
};

struct ReadResult {
    Bytes bytes;
    std::string error;  ///< empty: read; otherwise why not, for a person
};

/// Reads a whole regular file without ever blocking on a pipe or device. `progress` gets 0..1 between blocks and may
/// throw.
ReadResult read_regular_file(const std::filesystem::path& path, std::size_t max_bytes,
                             const std::function<void(double)>& progress = {});

/// True for "data:" URIs, which carry their bytes.
bool is_data_uri(std::string_view uri);

/// Bytes of a base64 data URI (RFC 2397, RFC 4648; padding optional, nothing else tolerated).
ReadResult decode_data_uri(std::string_view uri);

struct ResolvedUri {
    std::filesystem::path path;
    std::string error;  ///< empty: resolved
};

/// The file that a relative URI (RFC 3986, percent-encoded) names below `folder`; never outside it, never the network,
/// never the current directory.
ResolvedUri resolve_uri(const std::filesystem::path& folder, std::string_view uri);

}  // namespace si::gltf
