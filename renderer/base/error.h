// Errors that a person reads: one line, naming what, where and the remedy.
#pragma once

#include <stdexcept>

namespace si {

/// Something outside the program is wrong (a file, a driver, a value in a preset): exit code 1.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The command line itself is wrong (an unknown key, a value out of range): exit code 2.
struct UsageError : Error {
    using Error::Error;
};

}  // namespace si
