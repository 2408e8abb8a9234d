// Files that the program writes: complete or not at all (atomic_file.h).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "renderer/frame/frame.h"

namespace si {

/// @throws Error when `path` cannot become a file: a directory, a missing folder, no permission. Called before work
/// that takes long, so that it is not in vain.
void require_writable(const std::filesystem::path& path);

/// @throws UsageError when both are one file, behind links too; `one` and `other` are what they were given as. Empty
/// paths are none.
void require_distinct(const std::filesystem::path& a, std::string_view one, const std::filesystem::path& b,
                      std::string_view other);

/// Replaces `path` atomically; devices and pipes are written as they are. @throws Error
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// An 8-bit RGB PNG's bytes; alpha is dropped. @throws Error
std::string png_bytes(const ByteImage& image);

/// An 8-bit RGB PNG; alpha is dropped. @throws Error
void write_png(const std::filesystem::path& path, const ByteImage& image);

/// An 8-bit PNG of one channel: 0 black to 1 white. @throws Error
void write_grey_png(const std::filesystem::path& path, const FloatImage& image);

/// A portable float map of the image's first channel: little-endian, bottom row first. @throws Error
void write_pfm(const std::filesystem::path& path, const FloatImage& image);

/// A whole text file of at most 16 MiB. @throws Error
std::string read_text_file(const std::filesystem::path& path);

}  // namespace si
