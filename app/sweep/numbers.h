// What is measured of one case of a sweep, or of other settings.
#pragma once

#include <limits>
#include <optional>

#include "renderer/measure/time_sampler.h"
#include "renderer/reference/metrics.h"

namespace si {

struct CaseErrors {
    ErrorMetrics metrics;
    double noise = std::numeric_limits<double>::quiet_NaN();  ///< of the truth; NaN: unknown
};

/// Each part is there once it is measured.
struct CaseNumbers {
    std::optional<CaseErrors> error;
    std::optional<WorkCost> cost;
    std::optional<TimeMeasurement> time;
};

}  // namespace si
