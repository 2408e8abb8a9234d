// Atomic file writes: a file appears whole or not at all.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace si {

/// Writes a file atomically: the concatenated `parts` go to a temporary file in the same folder, are flushed to disk,
/// and then replace `path`. A process that is killed meanwhile leaves the old file and at most a hidden .tmp file. A
/// replaced file keeps its mode, and a symbolic link keeps its target.
/// @throws Error naming the file and the reason; the old file, if any, is then untouched.
void write_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

/// Returns the file that a write to `path` would replace, with all symbolic links resolved. Writes nothing. Used to
/// refuse a bad output path before any work.
/// @throws Error for dangling or circular links, names that are too long, and files without write permission
std::filesystem::path writable_target(const std::filesystem::path& path);

/// Makes a folder and its missing parent folders. Returns false if the folder existed before.
/// @throws Error naming the folder and the reason
bool make_folders(const std::filesystem::path& folder);

}  // namespace si
