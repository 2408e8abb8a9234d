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

/// Returns the system's message for the present value of errno, for error messages.
std::string errno_text();

/// Checks before long work that a file can be written at `path`. @throws Error for an empty path, a directory, a
/// missing folder, or a folder without write permission
void require_writable(const std::filesystem::path& path);

/// Checks that two output paths of a command name different files, also through links. Empty paths pass.
/// @param one, other options that gave the paths `a` and `b`, for the error message @throws UsageError
void require_distinct(const std::filesystem::path& a, std::string_view one, const std::filesystem::path& b,
                      std::string_view other);

/// Error of a command whose output file is also one of its input files.
struct OutputIsInput : UsageError {
    using UsageError::UsageError;
};

/// Checks that a command writes no file that it reads. Symbolic and hard links to a file count as that file.
/// @throws OutputIsInput
void require_outputs_not_read(std::span<const std::filesystem::path> outputs,
                              std::span<const std::filesystem::path> inputs);

/// Checks that a bundle to be written contains no file that is read, also through symbolic links. An older bundle is
/// replaced as a whole, and such a file with it.
/// @param bundle path of the folder or zip file to write @throws UsageError
void require_bundle_not_read(const std::filesystem::path& bundle, std::span<const std::filesystem::path> inputs);

/// Checks before long work that a file can be written at `path` and that its extension is one of `extensions`.
/// @param what name of the file in error messages, such as "the sheet" @throws UsageError for the extension; Error
void require_output(const std::filesystem::path& path, std::string_view what,
                    std::initializer_list<std::string_view> extensions);

/// Writes bytes to a file. A regular file is replaced atomically; devices and pipes are written directly. @throws Error
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Writes bytes to a regular file, replacing it atomically. Pipes, which could block, and devices are refused.
/// @throws Error
void write_regular_file(const std::filesystem::path& path, std::string_view bytes);

/// Returns true if something exists at `path` that a new file would replace: a file, a folder, or a link, even a broken
/// one.
bool is_taken(const std::filesystem::path& path);

/// Checks that `path` names no pipe, device or other special file. A missing file and a folder pass. @throws Error
void require_regular(const std::filesystem::path& path);

/// Encodes an image as 8-bit RGB PNG; alpha is dropped. @throws Error
std::string png_bytes(const ByteImage& image);

/// Encodes an image as JPEG. @param quality 1 (smallest file) to 100 (best) @throws Error
std::string jpg_bytes(const ByteImage& image, int quality = 85);

/// Writes an image as 8-bit RGB PNG file; alpha is dropped. @throws Error
void write_png(const std::filesystem::path& path, const ByteImage& image);

/// Encodes an image's first channel as portable float map (PFM): little-endian, bottom row first.
std::string pfm_bytes(const FloatImage& image);

/// Checks that an output path has the extension of a bundle (one frame of an engine as files): .bundle for a folder, or
/// .zip.
/// @throws UsageError
void require_bundle_name(const std::string& path);

/// Returns true if a path has the extension of an image file of floats: .pfm or .exr.
bool is_float_file(const std::filesystem::path& path);

/// Writes an image's first channel as a PFM or OpenEXR file; the extension of `path` chooses the format. @throws Error
void write_floats(const std::filesystem::path& path, const FloatImage& image);

/// Writes an image's first channel to a file. The extension of `path` chooses the format: PFM, OpenEXR, or 8-bit grey
/// PNG (0 black to 1 white; NaN black). @throws Error
void write_scalar_image(const std::filesystem::path& path, const FloatImage& image);

/// Reads a whole text file. @throws Error for a missing, unreadable or special file, or one above 16 MiB
std::string read_text_file(const std::filesystem::path& path);

}  // namespace si
