// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace si {

/// Writes the parts one after the other into a temporary file beside `path` and renames it over `path`.
/// @throws Error naming the file and the reason; the old file, if any, is then untouched.
void write_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

}  // namespace si
