// What a frame finds wrong with its shadows: computed on the GPU where the truth is at hand.
#pragma once

#include "renderer/reference/metrics.h"

namespace si {

struct LiveError {
    /// As error_metrics() has them, but for boundary_px_* (NaN). Undecided pixels are in no share that depends on edges.
    ErrorMetrics metrics;
    /// Pixels inside the map whose visibility differs from the truth and of which it is not known yet whether a true edge is
    /// near, and those of them that are false shadow or false light.
    std::size_t undecided = 0, undecided_wrong = 0;
};

}  // namespace si
