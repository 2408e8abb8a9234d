// Files that Assimp reads: regular files in one folder and below it, opened without following links.
#pragma once

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace si::assimp {

/// Reads a regular file at or below a folder. Never follows a link and never waits for a pipe or device.
/// @param folder descriptor of the folder @param name relative path; '\' counts as '/'
/// Returns nothing for a path that is absolute or leaves the folder, and for a file that is missing or too large.
std::optional<std::vector<std::uint8_t>> read_below(int folder, const std::string& name);

/// File access of Assimp, limited to one folder. Reads whole files and writes none.
class FolderFiles final : public Assimp::IOSystem {
public:
    /// @param folder descriptor of the folder; stays open while this object lives
    explicit FolderFiles(int folder) : folder_(folder) {}
    bool Exists(const char* file) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    void Close(Assimp::IOStream* file) override { delete file; }
    bool CreateDirectory(const std::string&) override { return false; }
    bool ChangeDirectory(const std::string&) override { return false; }
    bool DeleteFile(const std::string&) override { return false; }

    /// Returns the names of files that Assimp wanted to read and could not.
    const std::vector<std::string>& missing() const { return missing_; }

private:
    int folder_;
    std::vector<std::string> missing_;
};

}  // namespace si::assimp
