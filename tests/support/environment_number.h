// Reads numbers of repetitions and seeds from the environment, for longer runs by hand.
#pragma once

#include <cstdlib>

namespace si::test {

/// Returns the number in an environment variable, or `fallback` if the variable is missing or empty.
inline unsigned environment_number(const char* variable, unsigned fallback) {
    const char* text = std::getenv(variable);
    return text && *text ? unsigned(std::strtoul(text, nullptr, 10)) : fallback;
}

}  // namespace si::test
