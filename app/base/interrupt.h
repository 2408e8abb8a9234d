// SIGINT (Ctrl+C) and SIGTERM (from a batch system), for work that can stop between two steps.
#pragma once

namespace si {

/// Scope in which the first SIGINT or SIGTERM requests a stop instead of ending the program. The second signal ends the
/// program.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// Returns true once a signal has requested a stop.
    bool stop_requested() const;
    /// Ends the program by the signal that arrived, so that a shell sees exit code 130 or 143.
    [[noreturn]] void end();
};

}  // namespace si
