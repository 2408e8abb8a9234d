// The end of a sentence about a name that does not exist.
#pragma once

#include <string>

namespace si {

/// "; did you mean NEAREST?", or nothing where no name is like it.
inline std::string did_you_mean(const std::string& nearest) {
    return nearest.empty() ? std::string() : "; did you mean " + nearest + "?";
}

}  // namespace si
