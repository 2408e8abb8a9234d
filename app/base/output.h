// Output files. Each is written completely or not at all (atomic_file.h).
#pragma once

#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "renderer/base/error.h"
#include "renderer/frame/frame.h"

namespace si {

/// Returns the text of the last error of the system (errno).
std::string errno_text();

/// Checks before long work that a file can be written at `path`. @throws Error for a directory, a missing folder, no
/// permission
void require_writable(const std::filesystem::path& path);

/// Checks that two output paths name different files, links resolved. Empty paths are ignored. @param one, other names
/// of the options that gave the paths, for the message @throws UsageError
void require_distinct(const std::filesystem::path& a, std::string_view one, const std::filesystem::path& b,
                      std::string_view other);

/// Output of a command that it reads, too.
struct OutputIsInput : UsageError {
    using UsageError::UsageError;
};

/// Checks that no output is a file that is read: the same file, also through links and hard links.
/// @throws OutputIsInput
void require_no_input(std::span<const std::filesystem::path> outputs, std::span<const std::filesystem::path> inputs);

/// Checks before long work that a file can be written at `path` and that its extension is one of `extensions`.
/// @param what the file in the message: "the sheet" @throws UsageError, Error
void require_output(const std::filesystem::path& path, std::string_view what,
                    std::initializer_list<std::string_view> extensions);

/// Writes bytes to a file, replacing it atomically; devices and pipes are written directly. @throws Error
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Writes bytes to a regular file, replacing it atomically. A pipe, which could block, or a device is refused.
/// @throws Error
void write_regular_file(const std::filesystem::path& path, std::string_view bytes);

/// Returns true when writing at `path` would replace something: a file, a folder, or a link, also a broken one.
bool is_taken(const std::filesystem::path& path);

/// Checks that no pipe and no device is at `path`. @throws Error
void require_regular(const std::filesystem::path& path);

/// Encodes an image as 8-bit RGB PNG; alpha is dropped. @throws Error
std::string png_bytes(const ByteImage& image);

/// Encodes an image as JPEG. @throws Error
std::string jpg_bytes(const ByteImage& image, int quality = 85);

/// Writes an image as 8-bit RGB PNG file; alpha is dropped. @throws Error
void write_png(const std::filesystem::path& path, const ByteImage& image);

/// Encodes an image's first channel as portable float map (PFM): little-endian, bottom row first.
std::string pfm_bytes(const FloatImage& image);

/// Checks that an output names a bundle: a folder .bundle or a file .zip. @throws UsageError
void require_bundle_name(const std::string& path);

/// Returns true for the name of a file that holds floats: .pfm or .exr.
bool is_float_file(const std::filesystem::path& path);

/// Writes an image's first channel as PFM or OpenEXR file, by the extension of `path`. @throws Error
void write_floats(const std::filesystem::path& path, const FloatImage& image);

/// Writes an image's first channel as PFM, OpenEXR or 8-bit grey PNG file (0 black to 1 white), by the extension of
/// `path`. @throws Error
void write_scalar_image(const std::filesystem::path& path, const FloatImage& image);

/// Reads a text file of at most 16 MiB. @throws Error
std::string read_text_file(const std::filesystem::path& path);

}  // namespace si
