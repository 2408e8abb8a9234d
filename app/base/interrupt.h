// SIGINT (Ctrl+C), SIGTERM (from a batch system) and SIGHUP (a closed terminal), for work that can stop between two
// steps.
#pragma once

namespace si {

/// Scope in which the first SIGINT, SIGTERM or SIGHUP only requests a stop of the running work (stop_requested()). A
/// second signal ends the program. SIGHUP stays ignored where it was ignored before, as under `nohup`.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// Returns true once SIGINT, SIGTERM or SIGHUP has arrived, so that long work should stop at its next step.
    bool stop_requested() const;
    /// Ends the program by the signal that arrived (SIGHUP, SIGINT or SIGTERM), so that a shell sees exit code 129, 130
    /// or 143.
    [[noreturn]] static void end();
};

/// Returns true if SIGINT, SIGTERM or SIGHUP has arrived since the last InterruptGuard was made.
bool was_interrupted();

}  // namespace si
