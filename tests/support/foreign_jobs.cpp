#include "tests/support/foreign_jobs.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "renderer/base/error.h"
#include "renderer/scenes/foreign_jobs.h"

namespace si::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Request = std::span<const std::uint8_t>;
using Progress = std::function<void(double)>;

Bytes bytes_of(std::string_view text) {
    return {text.begin(), text.end()};
}

std::string text_of(Request bytes) {
    return {bytes.begin(), bytes.end()};
}

Bytes echo(Request request, const Progress& progress, int) {
    progress(0.5);
    return {request.begin(), request.end()};
}

Bytes refuse(Request request, const Progress&, int) {
    throw Error(text_of(request));
}

Bytes crash(Request, const Progress&, int) {
    ::signal(SIGSEGV, SIG_DFL);  // a sanitizer would report it
    ::raise(SIGSEGV);
    return {};
}

Bytes end_by_abort(Request, const Progress&, int) {
    std::abort();
}

Bytes quit(Request, const Progress&, int) {
    ::_exit(0);
}

Bytes loop(Request, const Progress& progress, int) {
    for (;;) progress(0.25);
}

Bytes take_memory(Request, const Progress&, int) {
    std::vector<Bytes> all;
    for (;;) all.emplace_back(std::size_t{16} << 20, std::uint8_t{1});
}

Bytes zeros(Request request, const Progress&, int) {
    return Bytes(std::stoul(text_of(request)));
}

/// Returns true when a thread starts.
bool starts_thread() {
    try {
        std::thread([] {}).join();
        return true;
    } catch (const std::system_error&) {
        return false;
    }
}

Bytes forbidden(Request, const Progress&, int folder) {
    std::string done;
    const auto note = [&](const char* what, bool succeeded) {
        if (succeeded) done += std::string(what) + " ";
    };
    note("fork", ::fork() >= 0);
    note("socket", ::socket(AF_INET, SOCK_STREAM, 0) >= 0);
    note("kill", ::kill(0, 0) == 0);
    note("create", ::open("created-by-a-child", O_CREAT | O_WRONLY, 0600) >= 0);
    note("create-below", ::openat(folder, "created-by-a-child", O_CREAT | O_WRONLY, 0600) >= 0);
    note("passwd", ::openat(folder, "/etc/passwd", O_RDONLY) >= 0);
    note("executable-memory",
         ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED);
    note("thread", starts_thread());
    for (int fd = folder >= 0 ? 4 : 3; fd < 1024; ++fd) {
        struct stat status {};
        note("descriptor", ::fstat(fd, &status) == 0);
    }
    char name[] = "/bin/true";
    char* words[] = {name, nullptr};
    ::execv(name, words);
    return bytes_of(done);
}

Bytes read_file(Request request, const Progress&, int folder) {
    const int file = ::openat(folder, text_of(request).c_str(), O_RDONLY | O_NOFOLLOW);
    if (file < 0) throw Error("the file cannot be opened");
    Bytes out(1000);
    out.resize(std::size_t(std::max<ssize_t>(::read(file, out.data(), out.size()), 0)));
    return out;
}

constexpr ForeignJob kJobs[] = {{"echo", "the test job", echo},           {"refuse", "the test job", refuse},
                                {"crash", "the test job", crash},         {"abort", "the test job", end_by_abort},
                                {"quit", "the test job", quit},           {"loop", "the test job", loop},
                                {"memory", "the test job", take_memory},  {"zeros", "the test job", zeros},
                                {"forbidden", "the test job", forbidden}, {"read", "the test job", read_file}};

}  // namespace

const std::vector<ForeignJob>& all_foreign_jobs() {
    static const std::vector<ForeignJob> all = [] {
        const std::span<const ForeignJob> program = foreign_jobs();
        std::vector<ForeignJob> jobs(program.begin(), program.end());
        jobs.insert(jobs.end(), std::begin(kJobs), std::end(kJobs));
        return jobs;
    }();
    return all;
}

const ForeignJob& foreign_job(const char* name) {
    const auto found = std::ranges::find(all_foreign_jobs(), std::string_view(name), &ForeignJob::name);
    if (found == all_foreign_jobs().end()) throw std::logic_error(name);
    return *found;
}

}  // namespace si::test
