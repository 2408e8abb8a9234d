// Parent side of run_foreign_job().
#include "renderer/foreign/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <string>
#include <thread>

#include "renderer/base/descriptor.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/foreign/sanitized.h"
#include "renderer/foreign/wire.h"

namespace si {
namespace foreign {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kPollMs = 50;
constexpr std::size_t kBlock = std::size_t{1} << 20;

/// Moves a descriptor above those that a child takes.
void raise_descriptor(Descriptor& of) {
    const int high = ::fcntl(of.fd, F_DUPFD_CLOEXEC, kFolder + 1);
    of = Descriptor(high);
}

/// Running child process. Its destructor kills the whole process group.
class Process {
public:
    Process(const ForeignJob& job, const ForeignLimits& limits, int socket, int folder) {
        posix_spawn_file_actions_t files;
        ::posix_spawn_file_actions_init(&files);
        ::posix_spawn_file_actions_adddup2(&files, socket, kSocket);
        ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        if (!kSanitized)  // whose findings are to be seen
            ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        if (folder >= 0) ::posix_spawn_file_actions_adddup2(&files, folder, kFolder);

        posix_spawnattr_t attributes;
        ::posix_spawnattr_init(&attributes);
        sigset_t all, none;
        ::sigfillset(&all);
        ::sigemptyset(&none);
        ::posix_spawnattr_setsigdefault(&attributes, &all);
        ::posix_spawnattr_setsigmask(&attributes, &none);
        ::posix_spawnattr_setpgroup(&attributes, 0);
        ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);

        std::string words[] = {"shadow-inspector",
                               kChildOption,
                               job.name,
                               std::to_string(::getpid()),
                               std::to_string(limits.memory_bytes),
                               std::to_string(limits.processor_s),
                               folder >= 0 ? "1" : "0"};
        char* argv[std::size(words) + 1] = {};
        std::ranges::transform(words, argv, [](std::string& word) { return word.data(); });
        const int error = ::posix_spawn(&pid_, "/proc/self/exe", &files, &attributes, argv, environ);
        ::posix_spawnattr_destroy(&attributes);
        ::posix_spawn_file_actions_destroy(&files);
        if (error != 0)
            throw Error(fmt::format("{} cannot be started as a process ({})", job.label, std::strerror(error)));
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process() {
        if (pid_ <= 0) return;
        ::kill(-pid_, SIGKILL);
        ::kill(pid_, SIGKILL);  // before it has a group of its own
        while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }

    /// Waits for the end of a child that has closed its socket. Returns its wait status; nothing after two seconds.
    std::optional<int> wait_status() {
        const auto end = Clock::now() + std::chrono::seconds(2);
        while (Clock::now() < end) {
            int status = 0;
            const pid_t got = ::waitpid(pid_, &status, WNOHANG);
            if (got == 0 || (got < 0 && errno == EINTR)) {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                continue;
            }
            pid_ = -1;
            if (got < 0) return std::nullopt;
            return status;
        }
        return std::nullopt;
    }

private:
    pid_t pid_ = -1;
};

/// Returns the sentence on a child that ended without an answer.
std::string end_text(const ForeignJob& job, const ForeignLimits& limits, std::optional<int> status) {
    if (status && WIFSIGNALED(*status)) {
        const int signal = WTERMSIG(*status);
        if (signal == SIGXCPU)
            return fmt::format("{} takes more than {} s of processor time", job.label, limits.processor_s);
        return fmt::format("{} ended while it read the file (signal {}, {})", job.label, signal, ::strsignal(signal));
    }
    return fmt::format("{} ended without an answer", job.label);
}

/// Conversation of the parent with one child.
class Exchange {
public:
    Exchange(const ForeignJob& job, std::span<const std::uint8_t> request, const ForeignLimits& limits,
             const std::function<bool(double)>& progress)
        : job_(job), request_(request), limits_(limits), progress_(progress) {}

    /// Sends the request and reads messages up to the last one. @throws Error
    std::vector<std::uint8_t> run(Process& process, int socket) {
        const auto end = Clock::now() + std::chrono::seconds(10 * limits_.processor_s);
        for (;;) {
            if (progress_ && !progress_(shown_)) throw Error("cancelled");
            if (Clock::now() > end)
                throw Error(fmt::format("{} is not done after {} s", job_.label, 10 * limits_.processor_s));
            pollfd ready{socket, short(POLLIN | (sending_ ? POLLOUT : 0)), 0};
            if (::poll(&ready, 1, kPollMs) <= 0) continue;
            if (ready.revents & POLLOUT) send_some(socket);
            if (!(ready.revents & (POLLIN | POLLHUP | POLLERR))) continue;
            if (!receive_some(socket)) throw Error(end_text(job_, limits_, process.wait_status()));
            if (done_) return std::move(body_);
        }
    }

private:
    void send_some(int socket) {
        const std::size_t size = std::min(kBlock, request_.size());
        const ssize_t sent = size == 0 ? 0 : ::send(socket, request_.data(), size, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && (errno == EAGAIN || errno == EINTR)) return;
        if (sent > 0) request_ = request_.subspan(std::size_t(sent));
        if (sent >= 0 && !request_.empty()) return;
        sending_ = false;  // all is sent, or the child is gone, which receive_some() reports
        ::shutdown(socket, SHUT_WR);
    }

    /// Reads a part of a message. Returns false at the end of the stream.
    bool receive_some(int socket) {
        if (wanted_ == 0) return receive_header(socket);
        const std::size_t old = body_.size();
        body_.resize(old + std::min(kBlock, wanted_));
        const ssize_t got = ::recv(socket, body_.data() + old, body_.size() - old, MSG_DONTWAIT);
        body_.resize(old + std::size_t(std::max<ssize_t>(got, 0)));
        if (got < 0) return errno == EAGAIN || errno == EINTR;
        if (got == 0) return false;
        wanted_ -= std::size_t(got);
        if (wanted_ == 0) finish_message();
        return true;
    }

    bool receive_header(int socket) {
        const ssize_t got = ::recv(socket, header_.data() + header_size_, header_.size() - header_size_, MSG_DONTWAIT);
        if (got < 0) return errno == EAGAIN || errno == EINTR;
        if (got == 0) return false;
        header_size_ += std::size_t(got);
        if (header_size_ < header_.size()) return true;
        header_size_ = 0;
        const MessageHeader header = unpack(header_);
        kind_ = header.kind;
        const std::size_t limit = kind_ == Message::Answer ? limits_.answer_bytes : kMaxFailureBytes;
        if (header.bytes > limit)
            throw Error(fmt::format("{} returns {} bytes, more than the limit of {}", job_.label, header.bytes, limit));
        body_.clear();
        wanted_ = std::size_t(header.bytes);
        if (wanted_ == 0) finish_message();
        return true;
    }

    void finish_message() {
        if (kind_ == Message::Failure)
            throw Error(printable({reinterpret_cast<const char*>(body_.data()), body_.size()}, kMaxFailureBytes));
        if (kind_ == Message::Answer) done_ = true;
        double fraction = 0;
        if (kind_ != Message::Progress || body_.size() != sizeof fraction) return;
        std::memcpy(&fraction, body_.data(), sizeof fraction);
        if (fraction >= 0 && fraction <= 1) shown_ = fraction;
    }

    const ForeignJob& job_;
    std::span<const std::uint8_t> request_;
    const ForeignLimits& limits_;
    const std::function<bool(double)>& progress_;
    std::vector<std::uint8_t> body_;
    std::size_t wanted_ = 0, header_size_ = 0;
    PackedHeader header_{};
    Message kind_ = Message::Failure;
    bool sending_ = true, done_ = false;
    double shown_ = 0;
};

}  // namespace
}  // namespace foreign

std::vector<std::uint8_t> run_foreign_job(const ForeignJob& job, std::span<const std::uint8_t> request,
                                          const ForeignLimits& limits, const std::filesystem::path* folder,
                                          const std::function<bool(double)>& progress) {
    using namespace foreign;
    int pair[2] = {-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
        throw Error(fmt::format("{} cannot be started as a process ({})", job.label, std::strerror(errno)));
    Descriptor here(pair[0]), there(pair[1]), files;
    raise_descriptor(there);
    if (folder) {
        files.fd = ::open(folder->empty() ? "." : folder->c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (files.fd < 0) throw Error(fmt::format("the file's folder cannot be opened ({})", std::strerror(errno)));
        raise_descriptor(files);
    }
    Process process(job, limits, there.fd, files.fd);
    there.close();
    return Exchange(job, request, limits, progress).run(process, here.fd);
}

}  // namespace si
