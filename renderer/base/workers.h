// Parallel loops with progress and cancellation, for the ray-traced reference.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

#include "renderer/base/error.h"

namespace si {

/// Exception that ends a long computation after a stop was requested (Workers::stop).
struct Cancelled : Error {
    Cancelled() : Error("cancelled") {}
};

/// Thread count, stop token and progress callback for a long computation.
struct Workers {
    int threads = 0;  ///< 0: as many as the hardware runs at once
    std::stop_token stop;
    std::function<void(double)> progress = nullptr;  ///< called with 0..1, rising, on the caller's thread only
    /// Returns the number of threads that a parallel loop of this computation uses, at least 1.
    int count() const;
    /// Returns a copy of thread count, stop token and progress callback for one step of a longer computation. The
    /// step's progress 0..1 is reported as lo..hi.
    Workers with_progress_range(double lo, double hi) const;
};

/// Calls work(i) once for every i below `blocks`, on several threads and in no order; the calling thread takes part.
/// Threads flush denormal floats to zero, as Embree requires. The first exception stops all threads and is rethrown to
/// the caller.
/// @throws Cancelled after a stop was requested
void parallel_for_blocks(std::size_t blocks, const Workers& workers, const std::function<void(std::size_t)>& work);

}  // namespace si
