// Notes and progress for the user on stderr. Notes are printed after the work, so that an error is the only line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/workers.h"

namespace si {

/// Writes text to stderr and ignores write errors, so that a closed or full stderr never stops the program's work.
void print_to_stderr(std::string_view text) noexcept;

/// Prints notes for the user to stderr, one per line, each after the word "note:".
void print_notes(const std::vector<std::string>& notes);

/// Returns the thread count and the progress callback for tracing rays. If stderr is a terminal, the callback prints
/// the percentage done there.
/// @param threads number of threads; 0: all cores
Workers workers_with_progress(int threads = 0);

/// Joins a text of several lines into one line for a message. Line breaks become "; ", tabs become spaces, and other
/// control characters become visible escapes.
std::string one_line(const std::string& text);

/// Prints "wrote FILE" to stdout, with control characters in the name escaped.
void print_wrote(const std::filesystem::path& file);

/// Opens the null device for each closed standard descriptor (0 to 2). Otherwise the next opened file would get that
/// descriptor and receive the program's messages. Writing to a stdout that was closed still fails. Call at the
/// beginning of main().
void open_standard_descriptors();

/// Ignores the signal SIGXFSZ. Writing a file beyond the size limit (`ulimit -f`) then fails with an error instead of
/// ending the program. Call at the beginning of main().
void survive_file_limits();

/// Flushes stdout at the end of a command. @throws Error when some output could not be written, as on a full disk
void finish_stdout();

}  // namespace si
