// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace si {

/// Writes the parts one after the other into a new file beside `path`, has them put on the disk, and moves it over
/// `path`; what is killed on the way leaves the old file, or none, and at most a hidden .tmp beside it. A file that is
/// replaced keeps its mode, a link leads where it led before.
/// @throws Error naming the file and the reason; the old file, if any, is then untouched.
void write_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

/// The file that would be written under this name, behind all links.
/// @throws Error of links that lead nowhere or in a circle, names that are too long, and files that may not be written
std::filesystem::path writable_target(const std::filesystem::path& path);

}  // namespace si
