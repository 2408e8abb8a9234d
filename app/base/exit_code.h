// Exit codes of the program, and the exception for a limit that a picture exceeds.
#pragma once

#include <stdexcept>

namespace si {

/// Exit codes of the program (docs/cli.md). A program that a signal ends has the exit code 128 plus the number of the
/// signal.
enum class ExitCode {
    Done = 0,
    Failed = 1,         ///< a file, a value in a file, or the driver caused an error
    WrongUsage = 2,     ///< the command line is wrong
    LimitExceeded = 3,  ///< `check` measured everything, and an error exceeds its limit
};

/// Returns the number of an exit code, as a process returns it.
constexpr int exit_status(ExitCode code) {
    return static_cast<int>(code);
}

/// Exception of the command `check`: a measured error of the picture exceeds a limit that the user has set. The program
/// then exits with code 3.
struct LimitExceeded : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace si
