// Remarks for a person, on stderr; printed only after the work is done, so that a failure is the only line.
#pragma once

#include <string>
#include <vector>

namespace si {

void print_notes(const std::vector<std::string>& notes);

/// `text` on one line: line breaks become "; ", other control characters spaces.
std::string one_line(const std::string& text);

/// @throws Error when stdout could not take everything that was printed (a full disk).
void finish_stdout();

}  // namespace si
