// Suggestion at the end of an error about an unknown name.
#pragma once

#include <string>

namespace si {

/// Formats the suggestion that ends an error about an unknown name: "; did you mean NEAREST?". Empty if `nearest` is
/// empty.
inline std::string did_you_mean(const std::string& nearest) {
    return nearest.empty() ? std::string() : "; did you mean " + nearest + "?";
}

}  // namespace si
