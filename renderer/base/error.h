// Exceptions whose text is shown to the user: one line that names the problem, its place and the fix.
#pragma once

#include <stdexcept>

namespace si {

/// Exception for a problem outside the program (a file, a driver, a value in a preset). The program exits with code 1.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Exception for a wrong command line (an unknown key, a value out of range). The program exits with code 2.
struct UsageError : Error {
    using Error::Error;
};

}  // namespace si
