// Long work of a command with a progress line on stderr that Ctrl+C can stop.
#pragma once

#include <fmt/format.h>

#include <stop_token>
#include <string>

#include "app/base/interrupt.h"
#include "app/base/notes.h"
#include "app/sweep/progress_line.h"
#include "renderer/base/workers.h"

namespace si {

/// Runs `work(workers, report)` and returns its result. report(share, text) updates the progress line and lets Ctrl+C
/// stop the work. @param lost clause for the message after Ctrl+C: "nothing was written"
template <class Work>
auto interruptible(const char* lost, const Work& work) {
    InterruptGuard interrupt;
    std::stop_source stop;
    try {
        ProgressLine line;
        const Workers workers{.stop = stop.get_token()};
        return work(workers, [&](double share, const std::string& what) {
            if (interrupt.stop_requested()) stop.request_stop();
            line.show(fmt::format("{:3.0f} %  {}", 100 * share, what), false);
        });
    } catch (const Cancelled&) {
        print_to_stderr(fmt::format("shadow-inspector: interrupted; {}\n", lost));
        interrupt.end();
    }
}

}  // namespace si
