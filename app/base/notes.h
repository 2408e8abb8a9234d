// Remarks for a person, on stderr; printed only after the work is done, so that a failure is the only line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/workers.h"

namespace si {

/// Writes on stderr as far as that takes it; nothing that a person is told may end the work.
void tell(std::string_view text) noexcept;

void print_notes(const std::vector<std::string>& notes);

/// Workers that write how far they are on stderr, where a person looks on. @param threads 0: all
Workers tracing_workers(int threads = 0);

/// `text` on one line: line breaks become "; ", tabs spaces, other control characters visible escapes.
std::string one_line(const std::string& text);

/// Says on stdout that a file was written; control characters in its name are shown, not sent to the terminal.
void print_wrote(const std::filesystem::path& file);

/// Opens those of the descriptors 0 to 2 that are closed on the null device, so that no file that is opened later takes
/// their number and is written what is meant for a person. Writing to a stdout that was closed still fails.
void open_standard_descriptors();

/// Has a file that grows beyond its limit (`ulimit -f`) fail to be written, which is told, in place of ending the
/// program.
void survive_file_limits();

/// @throws Error when stdout could not take everything that was printed (a full disk).
void finish_stdout();

}  // namespace si
