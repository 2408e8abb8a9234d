#include "app/base/notes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "renderer/base/error.h"

namespace si {

std::string one_line(const std::string& text) {
    std::string line;
    for (const char c : text) {
        if (c == '\n') {
            line += "; ";
        } else {
            line += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
        }
    }
    while (line.ends_with("; ")) line.erase(line.size() - 2);
    return line;
}

Workers tracing_workers(int threads) {
    Workers workers{.threads = threads};
    if (!::isatty(STDERR_FILENO)) return workers;
    workers.progress = [last = -1](double t) mutable {
        const int percent = int(t * 100);
        if (percent != last) fmt::print(stderr, "\rtracing {} %{}", last = percent, percent == 100 ? "\r\033[K" : "");
        std::fflush(stderr);
    };
    return workers;
}

void print_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", one_line(note));
}

void finish_stdout() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
        throw Error(fmt::format("standard output could not be written: {}", std::strerror(errno)));
    }
}

}  // namespace si
