#include "app/notes.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "renderer/error.h"

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

void print_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", one_line(note));
}

void finish_stdout() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
        throw Error(fmt::format("standard output could not be written: {}", std::strerror(errno)));
    }
}

}  // namespace si
