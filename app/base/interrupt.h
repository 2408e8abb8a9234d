// Ctrl+C and the end that a batch system announces, for work that can stop between two steps.
#pragma once

namespace si {

/// While it lives, SIGINT and SIGTERM ask for a stop instead of ending the program; the second one ends it.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool asked() const;
    /// Ends the program by the signal that asked, so that whoever started it knows (exit code 130 or 143 in a shell).
    [[noreturn]] void end();
};

}  // namespace si
