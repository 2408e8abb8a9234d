// Escaping of untrusted text for terminals, logs and the window.
#pragma once

#include <string>
#include <string_view>

namespace si {

/// Makes text from a file safe to display: control characters, bidirectional marks and broken UTF-8 become visible
/// escapes such as \x1b or \u202e. Text longer than `max_bytes` is cut at a character and ends in "…".
std::string printable(std::string_view text, std::size_t max_bytes = 160);

/// Returns true for text that is valid UTF-8, as JSON requires.
bool is_utf8(std::string_view text);

}  // namespace si
