// Long work of a command with a progress line on stderr that Ctrl+C can stop.
#pragma once

#include <fmt/format.h>

#include <stop_token>
#include <string>

#include "app/base/interrupt.h"
#include "app/base/notes.h"
#include "app/base/time_left.h"
#include "app/sweep/progress_line.h"
#include "renderer/base/workers.h"

namespace si {

/// Runs `work(workers, report)` and returns its result. report(share, text) updates the progress line. Ctrl+C requests
/// a stop of `workers`; if the work then throws Cancelled, the program ends with a message. @param lost a clause for
/// the message: "nothing was written"
template <class Work>
auto interruptible(const std::string& lost, const Work& work) {
    InterruptGuard interrupt;
    std::stop_source stop;
    const auto check = [&](double = 0) {
        if (interrupt.stop_requested()) stop.request_stop();
    };
    try {
        ProgressLine line;
        const TimeLeft left;
        const Workers workers{.stop = stop.get_token(), .progress = check};
        return work(workers, [&](double share, const std::string& what) {
            check();
            line.show(share, left.seconds(share), what);
        });
    } catch (const Cancelled&) {
        print_to_stderr(fmt::format("shadow-inspector: interrupted; {}\n", lost));
        interrupt.end();
    }
}

/// Prints a message and ends the program by the signal that stopped the work (Ctrl+C); returns if there was no signal.
/// Call once the results so far are printed. @param lost a clause for the message: "nothing was written"
inline void end_if_interrupted(const std::string& lost) {
    if (!was_interrupted()) return;
    print_to_stderr(fmt::format("shadow-inspector: interrupted; {}\n", lost));
    InterruptGuard::end();
}

}  // namespace si
