// Numbers in texts of users.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace si {

/// Parses a text that is one finite number and nothing else. Returns nothing for any other text.
inline std::optional<double> finite_number(std::string_view text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value)) return {};
    return value;
}

}  // namespace si
