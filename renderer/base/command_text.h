// Text of command lines for a POSIX shell: quoted words, and settings as --set options.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace si {

/// Quotes `text` for a POSIX shell; returns it unchanged where the shell reads it as one word anyway.
std::string shell_quoted(std::string_view text);

/// Formats setting changes as command-line options: "--set bias.normal=0 --set bias.constant=2.1". Empty for no change.
/// @param changes pairs of setting key and value
std::string set_options_text(std::span<const std::pair<std::string, std::string>> changes);

}  // namespace si
