#include "renderer/importers/assimp_files.h"

#include <assimp/MemoryIOWrapper.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string_view>
#include <utility>

namespace si::assimp {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
constexpr std::size_t kMaxMissing = 20;
constexpr std::size_t kMaxPathBytes = 4096;

/// Opened file or folder; closes itself.
class Opened {
public:
    explicit Opened(int fd) : fd_(fd) {}
    Opened(Opened&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Opened& operator=(Opened&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~Opened() {
        if (fd_ >= 0) ::close(fd_);
    }
    int fd() const { return fd_; }

private:
    int fd_;
};

/// Opens a regular file below a folder, one path component after the other, so that no link is followed. Holds -1 on
/// failure.
Opened open_below(int folder, std::string name) {
    Opened at(-1);
    if (name.find('\0') != name.npos || name.size() > kMaxPathBytes) return at;
    std::ranges::replace(name, '\\', '/');
    const fs::path path = fs::path(name).lexically_normal();
    if (path.empty() || path.is_absolute() || *path.begin() == "..") return at;
    for (auto part = path.begin(); part != path.end(); ++part) {
        const bool last = std::next(part) == path.end();
        const int flags = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (last ? 0 : O_DIRECTORY);
        at = Opened(::openat(at.fd() < 0 ? folder : at.fd(), part->c_str(), flags));
        if (at.fd() < 0) return at;
    }
    struct stat status {};
    if (::fstat(at.fd(), &status) != 0 || !S_ISREG(status.st_mode)) return Opened(-1);
    return at;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> read_below(int folder, const std::string& name) {
    const Opened file = open_below(folder, name);
    struct stat status {};
    if (file.fd() < 0 || ::fstat(file.fd(), &status) != 0) return std::nullopt;
    if (std::uint64_t(status.st_size) > kMaxFileBytes) return std::nullopt;
    std::vector<std::uint8_t> bytes(std::size_t(status.st_size));
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t got = ::read(file.fd(), bytes.data() + done, bytes.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return std::nullopt;
        done += std::size_t(got);
    }
    return bytes;
}

bool FolderFiles::Exists(const char* file) const {
    return open_below(folder_, file).fd() >= 0;
}

Assimp::IOStream* FolderFiles::Open(const char* file, const char* mode) {
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
    const auto bytes = read_below(folder_, file);
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
