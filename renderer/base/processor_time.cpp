#include "renderer/base/processor_time.h"

#include <unistd.h>

#include <charconv>
#include <ctime>
#include <filesystem>
#include <string>

namespace si {
namespace {

double clock_ms(clockid_t clock) {
    timespec time{};
    if (clock_gettime(clock, &time) != 0) return 0;
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

}  // namespace

std::vector<ThreadId> other_threads() {
    std::vector<ThreadId> out;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task", ignored)) {
        const std::string name = entry.path().filename();
        ThreadId id = 0;
        std::from_chars(name.data(), name.data() + name.size(), id);
        if (id != 0 && id != gettid()) out.push_back(id);
    }
    return out;
}

double processor_ms(ThreadId thread) {
    // The kernel's number of a thread's clock, as in MAKE_THREAD_CPUCLOCK of linux/posix-timers.h: the thread's
    // complement, the bit of threads (4) and the clock of scheduled time (2). pthread_getcpuclockid() asks for a handle
    // that only the thread's creator has.
    return clock_ms(clockid_t((~unsigned(thread) << 3) | 6));
}

double own_processor_ms() {
    return clock_ms(CLOCK_THREAD_CPUTIME_ID);
}

}  // namespace si
