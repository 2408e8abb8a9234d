// Notes and progress for the user on stderr. Notes are printed after the work, so that an error is the only line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/workers.h"

namespace si {

/// Writes text to stderr and ignores write errors, so that a message never ends the work.
void print_to_stderr(std::string_view text) noexcept;

/// Prints notes to stderr, one a line.
void print_notes(const std::vector<std::string>& notes);

/// Returns worker threads for ray tracing that print their progress to stderr if stderr is a terminal. @param threads
/// number of threads; 0: all cores
Workers tracing_workers(int threads = 0);

/// Puts text on one line: line breaks become "; ", tabs spaces, other control characters visible escapes.
std::string one_line(const std::string& text);

/// Prints "wrote FILE" to stdout, with control characters in the name escaped.
void print_wrote(const std::filesystem::path& file);

/// Opens the null device for each closed standard descriptor (0 to 2). Otherwise a file opened later would get that
/// descriptor and receive the program's messages. Writing to a stdout that was closed still fails.
void open_standard_descriptors();

/// Ignores SIGXFSZ: writing a file beyond the size limit (`ulimit -f`) becomes an error instead of ending the program.
void survive_file_limits();

/// Flushes stdout. @throws Error when some output could not be written (a full disk).
void finish_stdout();

}  // namespace si
