#include "renderer/importers/assimp_files.h"

#include <assimp/MemoryIOWrapper.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string_view>

#include "renderer/base/descriptor.h"

namespace si::assimp {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxMissing = 20;
constexpr std::size_t kMaxNames = 1000;
constexpr std::size_t kMaxPathBytes = 4096;

/// Opens a regular file below a folder, one path component after the other, so that no link is followed. Holds -1 on
/// failure.
Descriptor open_below(int folder, std::string name) {
    Descriptor at(-1);
    if (name.find('\0') != name.npos || name.size() > kMaxPathBytes) return at;
    std::ranges::replace(name, '\\', '/');
    const fs::path path = fs::path(name).lexically_normal();
    if (path.empty() || path.is_absolute() || *path.begin() == "..") return at;
    for (auto part = path.begin(); part != path.end(); ++part) {
        const bool last = std::next(part) == path.end();
        const int flags = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (last ? 0 : O_DIRECTORY);
        at = Descriptor(::openat(at.fd < 0 ? folder : at.fd, part->c_str(), flags));
        if (at.fd < 0) return at;
    }
    struct stat status {};
    if (::fstat(at.fd, &status) != 0 || !S_ISREG(status.st_mode)) return Descriptor(-1);
    return at;
}

}  // namespace

bool ModelFolder::has(const std::string& name) const {
    return open_below(descriptor_, name).fd >= 0;
}

std::optional<std::vector<std::uint8_t>> ModelFolder::read(const std::string& name) {
    if (names_.size() < kMaxNames && std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
    const Descriptor file = open_below(descriptor_, name);
    struct stat status {};
    if (file.fd < 0 || ::fstat(file.fd, &status) != 0) return std::nullopt;
    if (std::uint64_t(status.st_size) > kMaxFileBytes) return std::nullopt;
    std::vector<std::uint8_t> bytes(std::size_t(status.st_size));
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t got = ::read(file.fd, bytes.data() + done, bytes.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return std::nullopt;
        done += std::size_t(got);
    }
    return bytes;
}

bool FolderFiles::Exists(const char* file) const {
    return folder_.has(file);
}

Assimp::IOStream* FolderFiles::Open(const char* file, const char* mode) {
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
    const auto bytes = folder_.read(file);
    if (!bytes) {
        if (missing_.size() < kMaxMissing && std::ranges::find(missing_, file) == missing_.end())
            missing_.emplace_back(file);
        return nullptr;
    }
    auto* const copy = new std::uint8_t[std::max<std::size_t>(bytes->size(), 1)];
    std::ranges::copy(*bytes, copy);
    return new Assimp::MemoryIOStream(copy, bytes->size(), true);
}

}  // namespace si::assimp
