// Remarks for a person, on stderr; printed only after the work is done, so that a failure is the only line.
#pragma once

#include <string>
#include <vector>

#include "renderer/reference/workers.h"

namespace si {

void print_notes(const std::vector<std::string>& notes);

/// Workers that write how far they are on stderr, where a person looks on. @param threads 0: all
Workers tracing_workers(int threads = 0);

/// `text` on one line: line breaks become "; ", other control characters spaces.
std::string one_line(const std::string& text);

/// @throws Error when stdout could not take everything that was printed (a full disk).
void finish_stdout();

}  // namespace si
