// What is typed at a POSIX shell: words quoted where they need to be, settings as --set.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace si {

/// Quoted where a shell would not take it for one word.
std::string shell_quoted(std::string_view text);

/// "--set bias.normal=0 --set bias.constant=2.1"; empty of nothing. @param changes keys and values
std::string set_options_text(std::span<const std::pair<std::string, std::string>> changes);

}  // namespace si
