// Work in equal blocks on several threads, for the ray-traced truth.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

#include "renderer/base/error.h"

namespace si {

/// What a long computation throws when its stop token asks for it.
struct Cancelled : Error {
    Cancelled() : Error("cancelled") {}
};

/// Who computes, who may stop it, and who hears of it.
struct Workers {
    int threads = 0;  ///< 0: as many as the hardware runs at once
    std::stop_token stop;
    std::function<void(double)> progress = nullptr;  ///< 0..1, rising; called on the caller's thread only
    int count() const;                               ///< the number of threads used, >= 1
    /// The same, with 0..1 of its progress shown as lo..hi.
    Workers with_progress_range(double lo, double hi) const;
};

/// Calls work(i) for every i below `blocks`, each once, in no order; the caller works too. In each thread numbers too
/// small for normal floats count as zero, as Embree wants. The first exception ends all and is thrown again here.
/// @throws Cancelled
void parallel_for_blocks(std::size_t blocks, const Workers& workers, const std::function<void(std::size_t)>& work);

}  // namespace si
