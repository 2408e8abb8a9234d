#include "renderer/base/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "renderer/base/error.h"

namespace si {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view reason) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), reason));
}

}  // namespace

void write_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
    static std::atomic<unsigned> counter{0};  // two threads may write the same name
    std::filesystem::path temporary = path;
    temporary += fmt::format(".{}-{}.tmp", ::getpid(), counter.fetch_add(1));
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (!file) fail(path, std::strerror(errno));
    int error = 0;
    for (std::string_view part : parts)
        if (error == 0 && std::fwrite(part.data(), 1, part.size(), file) != part.size()) error = errno;
    if (std::fflush(file) != 0 && error == 0) error = errno;
    if (std::fclose(file) != 0 && error == 0) error = errno;
    std::error_code rename_error;
    if (error == 0) {
        std::filesystem::rename(temporary, path, rename_error);
        if (!rename_error) return;
    }
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    fail(path, error ? std::strerror(error) : rename_error.message());
}

}  // namespace si
