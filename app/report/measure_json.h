// Errors, times and costs as JSON, the same in `measure --json` and in a sweep's results.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/measure/time_sampler.h"
#include "renderer/reference/metrics.h"

namespace si {

/// {median, p95, low, high, median_low, median_high, noise}: noise is half the interval of the median.
nlohmann::ordered_json spread_json(const Spread& spread);
nlohmann::ordered_json time_json(const TimeMeasurement& time);
/// What files call a state of a pixel.
const char* state_key(PixelState state);
/// How the truth was found: {area, step, noise, noise_unknown_px, samples_used {least, mean, most}}; null where not
/// known.
nlohmann::ordered_json reference_quality_json(const Reference& reference);
/// What the shares and causes of an error mean; rows of different meanings are not to be compared.
/// 1: by distance to a true edge. 2: by the change that puts a pixel right.
/// 3: as 2, with polygon offset and contact shadows as causes of their own.
inline constexpr int kErrorMeaning = 3;
/// Numbers that are not finite become null.
nlohmann::ordered_json error_json(const ErrorMetrics& metrics);
/// With the truth's own noise (Truth::noise).
nlohmann::ordered_json error_json(const ErrorMetrics& metrics, double noise);
nlohmann::ordered_json cost_json(const WorkCost& cost);
/// What error_json() and cost_json() wrote; numbers that are missing are NaN, and counts 0.
ErrorMetrics error_from_json(const nlohmann::ordered_json& json);
WorkCost cost_from_json(const nlohmann::ordered_json& json);
/// The number under a field; NaN when it is missing or null.
double number_or_nan(const nlohmann::ordered_json& json, std::string_view field);

}  // namespace si
