#include "renderer/base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <random>
#include <system_error>
#include <utility>

#include "renderer/base/error.h"

namespace si {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, std::string_view reason) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), reason));
}

std::uint64_t unguessable() {
    std::uint64_t value = 0;
    if (::getrandom(&value, sizeof value, GRND_NONBLOCK) == ssize_t(sizeof value)) return value;
    std::random_device device;
    return std::uint64_t(device()) << 32 | device();
}

/// Returns a hidden temporary file name in the target's folder. It contains the target's name, cut to the longest
/// allowed name.
fs::path temporary_path(const fs::path& target) {
    constexpr std::size_t kMaxNameBytes = 100;
    std::string name = target.filename().string();
    if (name.size() > kMaxNameBytes) name.erase(0, name.size() - kMaxNameBytes);
    return target.parent_path() / fmt::format(".{}.{:016x}.tmp", name, unguessable());
}

int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(descriptor, bytes.data(), std::min(bytes.size(), std::size_t{1} << 30));
        if (n < 0 && errno != EINTR) return errno;
        if (n > 0) bytes.remove_prefix(std::size_t(n));
    }
    return 0;
}

/// Flushes a file to the disk. File systems without such a function count as success.
int onto_disk(int descriptor) {
    return ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS || errno == ENOSYS ? 0 : errno;
}

/// Flushes a folder to the disk, so that a rename survives a power failure. Ignores folders that cannot be opened.
void folder_onto_disk(const fs::path& folder) {
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    onto_disk(descriptor);
    ::close(descriptor);
}

/// Temporary file that is removed in the end unless it was renamed.
class Temporary {
public:
    Temporary(const fs::path& target, mode_t mode) {
        for (int i = 0; i < 8 && descriptor_ < 0; ++i) {
            path_ = temporary_path(target);
            descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
            if (descriptor_ < 0 && errno != EEXIST) break;
        }
        made_ = descriptor_ >= 0;
        error_ = made_ ? 0 : errno;
    }
    ~Temporary() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (made_) ::unlink(path_.c_str());
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    int error() const { return error_; }
    int descriptor() const { return descriptor_; }
    void then(int error) {
        if (error_ == 0) error_ = error;
    }
    void close() {
        if (::close(std::exchange(descriptor_, -1)) != 0) then(errno);
    }
    void move_to(const fs::path& target) {
        if (::rename(path_.c_str(), target.c_str()) != 0) return then(errno);
        made_ = false;
    }

private:
    fs::path path_;
    int descriptor_ = -1;
    bool made_ = false;
    int error_ = 0;
};

}  // namespace

fs::path writable_target(const fs::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) {
        if (errno == ENOENT) return path;
        fail(path, std::strerror(errno));
    }
    fs::path target = path;
    if (S_ISLNK(status.st_mode)) {
        std::error_code error;
        target = fs::canonical(path, error);
        if (error == std::errc::no_such_file_or_directory)
            fail(path, fmt::format("it is a link to {}, which does not exist", fs::read_symlink(path, error).string()));
        if (error) fail(path, "it is a link: " + error.message());
        if (::stat(target.c_str(), &status) != 0) fail(path, std::strerror(errno));
    }
    // Root could write a read-only file anyway, but its mode is respected.
    if (S_ISREG(status.st_mode) && (status.st_mode & 0222) == 0)
        fail(path, "it is read-only; choose another name, or make it writable");
    if (::access(target.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
    return target;
}

bool make_folders(const fs::path& folder) {
    std::error_code error;
    const bool made = fs::create_directories(folder, error);
    if (error) throw Error(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
    return made;
}

void write_atomically(const fs::path& path, std::initializer_list<std::string_view> parts) {
    const fs::path target = writable_target(path);
    struct stat old {};
    const bool replaces = ::stat(target.c_str(), &old) == 0;
    Temporary file(target, replaces ? 0600 : 0666);
    if (file.error() != 0) fail(path, std::strerror(file.error()));
    for (const std::string_view part : parts)
        if (file.error() == 0) file.then(write_all(file.descriptor(), part));
    if (replaces) {
        // The file keeps its owner where that is allowed. The owner comes first: changing it clears bits of the mode.
        if (::fchown(file.descriptor(), old.st_uid, old.st_gid) != 0) errno = 0;
        if (::fchmod(file.descriptor(), old.st_mode & 0777) != 0) file.then(errno);
    }
    if (file.error() == 0) file.then(onto_disk(file.descriptor()));
    file.close();
    if (file.error() == 0) file.move_to(target);
    if (file.error() != 0) fail(path, std::strerror(file.error()));
    folder_onto_disk(target.parent_path());
}

}  // namespace si
