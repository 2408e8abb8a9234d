// Reading of regular files of limited size. A pipe or a device never blocks the program.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace si {

/// Owner of an uninitialised block of heap memory for the content of a file.
struct Bytes {
    /// Deleter for malloc() memory.
    struct Free {
        void operator()(std::uint8_t* bytes) const { std::free(bytes); }
    };
    std::unique_ptr<std::uint8_t[], Free> data;
    std::size_t size = 0;
    Bytes() = default;
    /// Allocates `size` bytes, which are not initialised. Large blocks lie in huge pages, since page faults of 4 KiB
    /// pages would take as long as reading a file into them.
    /// @throws std::bad_alloc
    explicit Bytes(std::size_t size);
    /// Returns the bytes of the block.
    std::span<const std::uint8_t> span() const { return {data.get(), size}; }
    /// Returns the bytes of the block as text.
    std::string_view text() const { return {reinterpret_cast<const char*>(data.get()), size}; }
};

/// Bytes of a file or data URI, or the reason why they could not be read.
struct ReadResult {
    Bytes bytes;
    std::string error;  ///< empty: success; otherwise the reason, for people
};

/// Reads a whole regular file; never blocks on a pipe or device. Errors are returned, not thrown. Every file that the
/// user names, or that is found in a folder, is read by this function.
/// @param max_bytes larger files are an error @param progress called with 0..1 between blocks; may throw
ReadResult read_regular_file(const std::filesystem::path& path, std::size_t max_bytes,
                             const std::function<void(double)>& progress = {});

}  // namespace si
