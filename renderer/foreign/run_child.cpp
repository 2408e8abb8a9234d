// Child side of run_foreign_job().
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <new>
#include <optional>
#include <string>
#include <string_view>

#include "renderer/base/error.h"
#include "renderer/foreign/child.h"
#include "renderer/foreign/wire.h"

namespace si {
namespace foreign {
namespace {

/// Writes bytes to the parent. Ends the process when the parent is gone.
void write_all(const void* data, std::size_t size) {
    const auto* at = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::write(kSocket, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) ::_exit(1);
        at += written;
        size -= std::size_t(written);
    }
}

void send_message(Message kind, std::span<const std::uint8_t> body) {
    const PackedHeader header = pack({kind, body.size()});
    write_all(header.data(), header.size());
    write_all(body.data(), body.size());
}

void send_failure(std::string_view text) {
    text = text.substr(0, kMaxFailureBytes);
    send_message(Message::Failure, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::vector<std::uint8_t> read_request() {
    std::vector<std::uint8_t> out;
    for (std::size_t size = 0;;) {
        out.resize(std::max<std::size_t>(2 * size, 1 << 16));
        const ssize_t got = ::read(kSocket, out.data() + size, out.size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) ::_exit(1);
        size += std::size_t(got);
        if (got > 0) continue;
        out.resize(size);
        return out;
    }
}

template <class T>
std::optional<T> number(std::string_view text) {
    T out{};
    const auto read = std::from_chars(text.data(), text.data() + text.size(), out);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
    return out;
}

void run(const ForeignJob& job, bool folder) {
    std::chrono::steady_clock::time_point shown{};
    const auto progress = [&](double fraction) {
        const auto now = std::chrono::steady_clock::now();
        if (now - shown < std::chrono::milliseconds(20)) return;
        shown = now;
        const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(double)>>(fraction);
        send_message(Message::Progress, bytes);
    };
    try {
        const std::vector<std::uint8_t> request = read_request();
        send_message(Message::Answer, job.work(request, progress, folder ? kFolder : -1));
    } catch (const Error& error) {
        send_failure(error.what());
    } catch (const std::bad_alloc&) {
        send_failure(std::string(job.label) + " needs more memory than it may take");
    } catch (const std::exception&) {
        send_failure(std::string(job.label) + " cannot read the file");
    }
}

}  // namespace
}  // namespace foreign

void foreign_child_main(int argc, char** argv, std::span<const ForeignJob> jobs) {
    using namespace foreign;
    if (argc != 7 || std::string_view(argv[1]) != kChildOption) return;
    const auto job = std::ranges::find(jobs, std::string_view(argv[2]), &ForeignJob::name);
    const auto parent = number<pid_t>(argv[3]);
    const auto memory_bytes = number<std::size_t>(argv[4]);
    const auto processor_s = number<int>(argv[5]);
    const bool folder = std::string_view(argv[6]) == "1";
    if (job == jobs.end() || !parent || !memory_bytes || !processor_s) ::_exit(2);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != *parent) ::_exit(1);  // the parent died before its death was watched
    if (confine(*memory_bytes, *processor_s, folder))
        run(*job, folder);
    else
        send_failure(std::string(job->label) +
                     " does not run, because this kernel offers no filter of system calls (seccomp)");
    ::_exit(0);  // destructors of a process that foreign bytes may have changed do not run
}

}  // namespace si
