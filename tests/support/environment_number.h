// Numbers of runs by hand, from the environment.
#pragma once

#include <cstdlib>

namespace si::test {

/// What the variable says, or what is usual where it is missing or empty.
inline unsigned environment_number(const char* variable, unsigned usual) {
    const char* text = std::getenv(variable);
    return text && *text ? unsigned(std::strtoul(text, nullptr, 10)) : usual;
}

}  // namespace si::test
