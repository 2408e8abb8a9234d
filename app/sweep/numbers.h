// Numbers measured for one case of a sweep, or for other settings.
#pragma once

#include <limits>
#include <optional>

#include "renderer/measure/time_sampler.h"
#include "renderer/reference/metrics.h"

namespace si {

/// Error metrics with the noise of the reference.
struct CaseErrors {
    ErrorMetrics metrics;
    double noise = std::numeric_limits<double>::quiet_NaN();  ///< noise of the reference; NaN: unknown
};

/// Error, cost and time of one case of a sweep; parts that are not measured yet are empty.
struct CaseNumbers {
    std::optional<CaseErrors> error;
    std::optional<WorkCost> cost;
    std::optional<TimeMeasurement> time;
};

}  // namespace si
