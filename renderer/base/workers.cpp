#include "renderer/base/workers.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace si {
namespace {

/// Flush-to-zero and denormals-are-zero mode of the calling thread, for the lifetime of this object.
class FlushDenormals {
public:
#if defined(__SSE2__)
    FlushDenormals() : before_(_mm_getcsr()) {
        _mm_setcsr(before_ | 0x8040u);
    }
    ~FlushDenormals() {
        _mm_setcsr(before_);
    }

private:
    unsigned before_;
#endif
};

}  // namespace

int Workers::count() const {
    return threads > 0 ? threads : std::max(1, int(std::thread::hardware_concurrency()));
}

Workers Workers::with_progress_range(double lo, double hi) const {
    Workers out = *this;
    if (progress) out.progress = [report = progress, lo, hi](double t) { report(lo + (hi - lo) * t); };
    return out;
}

void parallel_for_blocks(std::size_t blocks, const Workers& workers, const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next{0}, done{0};
    std::atomic<bool> failed{false};
    std::exception_ptr error;
    std::mutex error_lock;
    const auto take = [&](bool report) {
        const FlushDenormals flush;
        try {
            for (std::size_t i; !failed && !workers.stop.stop_requested() && (i = next++) < blocks;) {
                work(i);
                ++done;
                if (report && workers.progress) workers.progress(double(done) / double(blocks));
            }
        } catch (...) {
            const std::lock_guard guard(error_lock);
            if (!error) error = std::current_exception();
            failed = true;
        }
    };
    {
        const std::size_t helpers = std::min<std::size_t>(std::size_t(workers.count()), blocks);
        std::vector<std::jthread> threads;
        for (std::size_t i = 1; i < helpers; ++i) threads.emplace_back([&] { take(false); });
        take(true);
    }
    if (error) std::rethrow_exception(error);
    if (workers.stop.stop_requested()) throw Cancelled();
    if (workers.progress) workers.progress(1);
}

}  // namespace si
