#include "app/base/notes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "renderer/base/error.h"
#include "renderer/base/printable.h"

namespace si {

std::string one_line(const std::string& text) {
    std::string line;
    for (const char c : text) {
        if (c == '\n')
            line += "; ";
        else
            line += c == '\t' || c == '\r' ? ' ' : c;
    }
    while (line.ends_with("; ")) line.erase(line.size() - 2);
    return printable(line, std::string::npos);
}

void print_wrote(const std::filesystem::path& file) {
    fmt::print("wrote {}\n", printable(file.string(), std::string::npos));
}

Workers workers_with_progress(int threads) {
    Workers workers{.threads = threads};
    if (!::isatty(STDERR_FILENO)) return workers;
    workers.progress = [last = -1](double t) mutable {
        const int percent = int(t * 100);
        if (percent == last) return;
        print_to_stderr(fmt::format("\rtracing {} %{}", last = percent, percent == 100 ? "\r\033[K" : ""));
    };
    return workers;
}

void print_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) print_to_stderr(fmt::format("note: {}\n", one_line(note)));
}

void print_to_stderr(std::string_view text) noexcept {
    if (std::fwrite(text.data(), 1, text.size(), stderr) != text.size()) std::clearerr(stderr);
    std::fflush(stderr);
}

void survive_file_limits() {
    std::signal(SIGXFSZ, SIG_IGN);
}

void open_standard_descriptors() {
    // open() returns the lowest free descriptor, so that they are filled in order.
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
            (void)::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

void finish_stdout() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        throw Error(fmt::format("standard output could not be written: {}", std::strerror(errno)));
}

}  // namespace si
