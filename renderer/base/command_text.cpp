#include "renderer/base/command_text.h"

namespace si {

std::string shell_quoted(std::string_view text) {
    static constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./%@";
    if (!text.empty() && text.find_first_not_of(kPlain) == text.npos) return std::string(text);
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string set_options_text(std::span<const std::pair<std::string, std::string>> changes) {
    std::string text;
    for (const auto& [key, value] : changes)
        text += (text.empty() ? "--set " : " --set ") + shell_quoted(key + "=" + value);
    return text;
}

}  // namespace si
