// Times and costs as JSON, the same in `measure --json` and in a sweep's results.
#pragma once

#include <nlohmann/json.hpp>

#include "renderer/measure/time_sampler.h"

namespace si {

/// {median, p95, low, high, median_low, median_high, noise}: noise is half the interval of the median.
nlohmann::ordered_json spread_json(const Spread& spread);
nlohmann::ordered_json time_json(const TimeMeasurement& time);
nlohmann::ordered_json cost_json(const WorkCost& cost);

}  // namespace si
