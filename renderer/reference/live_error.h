// Shadow error of a frame, computed on the GPU while it is drawn.
#pragma once

#include "renderer/reference/metrics.h"

namespace si {

/// Error metrics of a frame's shadows, which the GPU computes while the frame is drawn. Available when the frame has a
/// reference.
struct LiveError {
    /// Equal to error_metrics(), except boundary_px_* and any_leak, which are NaN. `flip` is NaN unless an overlay
    /// shows it.
    ErrorMetrics metrics;
};

}  // namespace si
