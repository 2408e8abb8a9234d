// Files of a bundle, read by name from a folder or a zip file, and written as either.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/file_stamp.h"
#include "renderer/bundle/bundle_contents.h"

namespace si {

/// Returns true when a path can be that of a bundle (an engine's frame as files): a folder or file that ends in
/// .bundle, a file that ends in .zip, or a frame.json. Opens no file.
bool is_bundle_path(const std::filesystem::path& path);

/// Reader of the files of a bundle, an engine's frame in a folder or a zip file. Files are read into memory by name;
/// nothing is unpacked to disk. In a folder no link is followed and only regular files are opened.
class BundleFiles {
public:
    /// Opens a bundle: a folder, its frame.json, a zip file, or the name of a built-in bundle (builtin_bundles.h). A
    /// zip file may hold all its files in one folder.
    /// @throws Error "PATH: what is wrong; what to do" for a file that is no bundle, and for zip files with forbidden
    /// names, links, duplicates, encryption or sizes
    explicit BundleFiles(const std::filesystem::path& path);
    ~BundleFiles();
    BundleFiles(BundleFiles&&) noexcept;
    BundleFiles& operator=(BundleFiles&&) noexcept;

    /// Reads a whole file of the bundle.
    /// @param name path of the file in the bundle
    /// @param max_bytes largest size that is accepted
    /// @throws Error naming the file, for a name that bundle_path_fault() refuses, and for a missing or too large file
    std::vector<std::byte> read(std::string_view name, std::size_t max_bytes);
    /// Returns true when the bundle (an engine's frame as files) has a regular file of this name.
    bool has(std::string_view name) const;
    /// Returns the name of one of the bundle's files for messages: "DIR/frame.bundle/maps/sun.pfm".
    std::string label(std::string_view name) const;
    /// Returns the files on disk that were read from this bundle so far, with their stamps, by which later changes are
    /// found. Stamps are taken before a file is read.
    std::vector<StampedFile> files_read() const;

private:
    struct Opened;
    std::unique_ptr<Opened> opened_;
};

/// Writes a bundle (an engine's frame as files) as a zip file if `path` ends in .zip, else as a folder. Equal contents
/// give equal bytes. The bundle appears whole or not at all. An older bundle of this name is replaced.
/// @throws Error naming the file, also if an existing folder contains files that belong to no bundle
void write_bundle_files(const BundleContents& contents, const std::filesystem::path& path);

}  // namespace si
