// Identity and time of a file's content, by which a later change is found without reading the file.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace si {

/// State of a regular file: device, inode, size and time of the last write. A later change of the file is found by
/// comparing stamps, without reading the file.
struct FileStamp {
    std::uint64_t device = 0, inode = 0;
    std::int64_t bytes = 0;
    std::int64_t written_ns = 0;  ///< last write, nanoseconds since 1970
    bool operator==(const FileStamp&) const = default;
};

/// Returns the FileStamp of a regular file, links resolved; nothing if there is no such file. Does not open the file.
inline std::optional<FileStamp> file_stamp(const std::filesystem::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    return FileStamp{.device = std::uint64_t(status.st_dev),
                     .inode = std::uint64_t(status.st_ino),
                     .bytes = std::int64_t(status.st_size),
                     .written_ns = std::int64_t(status.st_mtim.tv_sec) * 1'000'000'000 + status.st_mtim.tv_nsec};
}

/// Path of a file that was read, with the FileStamp from that time. A later change is found by comparing it with a new
/// stamp. No stamp: the file did not exist.
struct StampedFile {
    std::filesystem::path path;
    std::optional<FileStamp> stamp;
};

/// Returns a path together with the present stamp (FileStamp) of its file.
inline StampedFile stamped(const std::filesystem::path& path) {
    return {path, file_stamp(path)};
}

}  // namespace si
