#include "renderer/base/regular_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "renderer/base/descriptor.h"

namespace si {
namespace {

ReadResult failed(std::string why) {
    return {{}, std::move(why)};
}

}  // namespace

Bytes::Bytes(std::size_t wanted) : size(wanted) {
    constexpr std::size_t kHugePage = std::size_t{2} << 20;
    const bool large = size >= 2 * kHugePage;
    const std::size_t whole = (size + kHugePage - 1) / kHugePage * kHugePage;
    void* block = large ? std::aligned_alloc(kHugePage, whole) : std::malloc(std::max<std::size_t>(size, 1));
    data.reset(static_cast<std::uint8_t*>(block));
    if (!data) throw std::bad_alloc();
    if (large) ::madvise(data.get(), whole, MADV_HUGEPAGE);  // only a hint: small pages are slower
}

ReadResult read_regular_file(const std::filesystem::path& path, std::size_t max_bytes,
                             const std::function<void(double)>& progress) {
    // O_NONBLOCK: opening a FIFO without a writer would wait forever.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.fd < 0) return failed(fmt::format("cannot be opened ({})", std::strerror(errno)));
    struct stat status {};
    if (::fstat(file.fd, &status) != 0) return failed(fmt::format("cannot be examined ({})", std::strerror(errno)));
    if (S_ISDIR(status.st_mode)) return failed("is a directory");
    if (!S_ISREG(status.st_mode)) return failed("is not a regular file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > max_bytes) return failed(fmt::format("has {} bytes, more than the limit of {}", size, max_bytes));

    ReadResult result;
    result.bytes = Bytes(std::size_t(size));
    constexpr std::size_t kBlock = std::size_t{16} << 20;
    for (std::size_t done = 0; done < result.bytes.size;) {
        const ssize_t got = ::read(file.fd, result.bytes.data.get() + done, std::min(kBlock, result.bytes.size - done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return failed(fmt::format("cannot be read ({})", std::strerror(errno)));
        if (got == 0) return failed("became shorter while it was read");
        done += std::size_t(got);
        if (progress) progress(static_cast<double>(done) / static_cast<double>(result.bytes.size));
    }
    return result;
}

}  // namespace si
