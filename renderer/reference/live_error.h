// What a frame finds wrong with its shadows: computed on the GPU where the truth is at hand.
#pragma once

#include "renderer/reference/metrics.h"

namespace si {

struct LiveError {
    /// As error_metrics() has them, but for boundary_px_*, which are NaN.
    ErrorMetrics metrics;
};

}  // namespace si
