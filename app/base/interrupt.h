// SIGINT (Ctrl+C), SIGTERM (from a batch system) and SIGHUP (a closed terminal), for work that can stop between two
// steps.
#pragma once

namespace si {

/// Scope in which the first SIGINT, SIGTERM or SIGHUP requests a stop instead of ending the program. The second signal
/// ends the program. A SIGHUP that is ignored at the begin (`nohup`) stays ignored.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// Returns true once a signal has requested a stop.
    bool stop_requested() const;
    /// Ends the program by the signal that arrived, so that a shell sees exit code 129, 130 or 143.
    [[noreturn]] void end();
};

}  // namespace si
