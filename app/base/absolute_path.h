// Absolute paths of files that users name.
#pragma once

#include <filesystem>
#include <system_error>

namespace si {

/// Returns the absolute path without "." and "..". Symbolic links are not resolved.
inline std::filesystem::path absolute_path(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(path, error);
    return (error ? path : whole).lexically_normal();
}

}  // namespace si
