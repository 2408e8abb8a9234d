// Files that Assimp reads: regular files in one folder and below it, opened without following links.
#pragma once

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace si::assimp {

/// Largest size in bytes of a file that is read.
inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;

/// Folder of a model, with access to the regular files in it and below it. Never follows a link and never waits for a
/// pipe or device. File names are relative paths, in which '\' counts as '/'.
class ModelFolder {
public:
    /// @param descriptor open descriptor of the folder; must stay open while this object lives
    explicit ModelFolder(int descriptor) : descriptor_(descriptor) {}
    /// Returns true when the model's folder has a regular file of this name that can be opened.
    bool has(const std::string& name) const;
    /// Reads a whole file from the model's folder. Returns nothing for a path that is absolute or leaves the folder,
    /// and for a file that is missing or larger than 1 GiB.
    std::optional<std::vector<std::uint8_t>> read(const std::string& name);
    /// Returns the names of all files that read() was called for, missing ones too; at most 1,000.
    const std::vector<std::string>& names() const { return names_; }

private:
    int descriptor_;
    std::vector<std::string> names_;
};

/// File system for Assimp, limited to a model's folder. Reads whole files and writes none.
class FolderFiles final : public Assimp::IOSystem {
public:
    explicit FolderFiles(ModelFolder& folder) : folder_(folder) {}
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
    ModelFolder& folder_;
    std::vector<std::string> missing_;
};

}  // namespace si::assimp
