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

/// Returns true when a path is one of a bundle: a folder or file that ends in .bundle, a file that ends in .zip, or a
/// frame.json. Opens no file.
bool is_bundle_path(const std::filesystem::path& path);

/// Files of a bundle from elsewhere: a folder, the frame.json of one, or a zip file. Entries are read into memory by
/// name; nothing is unpacked to disk. In a folder no link is followed and only regular files are opened.
class BundleFiles {
public:
    /// Opens a bundle, or one that the program makes (see builtin_bundles.h). A zip file may hold all its files in one
    /// folder. @throws Error "PATH: what; what to do" for a file that is no bundle, and for zip files with forbidden
    /// names, links, duplicates, encryption or sizes
    explicit BundleFiles(const std::filesystem::path& path);
    ~BundleFiles();
    BundleFiles(BundleFiles&&) noexcept;
    BundleFiles& operator=(BundleFiles&&) noexcept;

    /// Reads a whole file of the bundle. @param name path in the bundle
    /// @throws Error naming the file, for a name that bundle_path_fault() refuses, a missing file, and one above
    /// `max_bytes`
    std::vector<std::byte> read(std::string_view name, std::size_t max_bytes);
    /// Returns true when the bundle has a regular file of this name.
    bool has(std::string_view name) const;
    /// Returns the name of a file of the bundle for messages: "DIR/frame.bundle/maps/sun.pfm".
    std::string label(std::string_view name) const;
    /// Returns the files on disk that were read so far, with stamps from before they were read.
    std::vector<StampedFile> files_read() const;

private:
    struct Opened;
    std::unique_ptr<Opened> opened_;
};

/// Writes a bundle as a zip file, where `path` ends in .zip, else as a folder. Equal contents give equal bytes. The
/// bundle appears whole or not at all. An older bundle of this name is replaced.
/// @throws Error naming the file, also for a folder that holds other things than a bundle
void write_bundle_files(const BundleContents& contents, const std::filesystem::path& path);

}  // namespace si
