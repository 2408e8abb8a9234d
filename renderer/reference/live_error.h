// Shadow error of a frame, computed on the GPU while it is drawn.
#pragma once

#include "renderer/reference/metrics.h"

namespace si {

/// Shadow error of a frame by the GPU's own sums, available when the frame has a reference.
struct LiveError {
    /// Equal to error_metrics(), except boundary_px_* and any_leak, which are NaN. `flip` is NaN unless an overlay
    /// shows it.
    ErrorMetrics metrics;
};

}  // namespace si
