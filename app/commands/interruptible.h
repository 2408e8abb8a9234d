// Long work of a command: how far it is on stderr, and an end by Ctrl+C.
#pragma once

#include <fmt/format.h>

#include <stop_token>
#include <string>

#include "app/base/interrupt.h"
#include "app/base/notes.h"
#include "app/sweep/progress_line.h"
#include "renderer/base/workers.h"

namespace si {

/// Returns what `work(workers, report)` does, where report(share, what) shows how far it is and hears of Ctrl+C.
/// @param lost what an interruption leaves undone, a clause: "nothing was written"
template <class Work>
auto interruptible(const char* lost, const Work& work) {
    InterruptGuard interrupt;
    std::stop_source stop;
    try {
        ProgressLine line;
        const Workers workers{.stop = stop.get_token()};
        return work(workers, [&](double share, const std::string& what) {
            if (interrupt.asked()) stop.request_stop();
            line.show(fmt::format("{:3.0f} %  {}", 100 * share, what), false);
        });
    } catch (const Cancelled&) {
        tell(fmt::format("shadow-inspector: interrupted; {}\n", lost));
        interrupt.end();
    }
}

}  // namespace si
