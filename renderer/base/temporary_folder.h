// Folder that exists until the end of a scope.
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

namespace si {

/// Owner of a new folder on disk. The destructor removes the folder with everything in it, unless release() was called.
class TemporaryFolder {
public:
    /// Makes a new folder on disk that only its owner may use. path() is empty if that fails, and errno says why.
    /// @param pattern path that ends in XXXXXX; a free name replaces these letters
    explicit TemporaryFolder(const std::filesystem::path& pattern);
    ~TemporaryFolder();
    TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Gives up the folder, which the caller has renamed: the destructor no longer removes it.
    void release() { path_.clear(); }

private:
    std::filesystem::path path_;
};

/// Makes a temporary folder in TMPDIR or the system's folder of temporary files.
/// @param name first part of the folder's name
/// @throws Error if the folder cannot be made
TemporaryFolder make_temporary_folder(std::string_view name);

}  // namespace si
