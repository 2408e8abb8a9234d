// Errors, times and costs as JSON, shared by `measure --json` and the results of sweeps.
#pragma once

#include <string_view>

#include "app/base/json_text.h"
#include "renderer/bundle/engine_bias.h"
#include "renderer/measure/time_sampler.h"
#include "renderer/reference/metrics.h"

namespace si {

/// Converts the source of an engine's bias to JSON: "file", "entered" or null.
nlohmann::ordered_json engine_bias_source_json(EngineBias bias);
/// Converts a distribution to JSON {median, p95, low, high, median_low, median_high, noise}; noise is half the
/// confidence interval of the median.
nlohmann::ordered_json spread_json(const Spread& spread);
/// Converts a measured frame time to JSON.
nlohmann::ordered_json time_json(const TimeMeasurement& time);
/// Returns the name of a pixel's state in JSON files.
const char* state_key(PixelState state);
/// Converts the quality of a ray-traced reference to JSON {area, step, noise, noise_unknown_px, samples_used {least,
/// mean, most}}; unknown values are null.
nlohmann::ordered_json reference_quality_json(const Reference& reference);
/// Version of the definitions of error shares and causes (JSON field `meaning`). Numbers of different versions must not
/// be compared. 1: by distance to a true edge. 2: by the change that makes a pixel right. 3: as 2, with polygon offset
/// and contact shadows as separate causes. 4: as 3, with light bleeding as a cause, and shadow terminators as a state.
inline constexpr int kErrorMeaning = 4;
/// Converts error metrics to JSON; numbers that are not finite become null.
nlohmann::ordered_json error_json(const ErrorMetrics& metrics);
/// Converts error metrics to JSON together with the noise of the reference (Reference::noise).
nlohmann::ordered_json error_json(const ErrorMetrics& metrics, double noise);
/// Converts the work of a frame (texels, taps, bytes) to JSON.
nlohmann::ordered_json cost_json(const WorkCost& cost);
/// Reads the JSON written by error_json(). Missing numbers become NaN, missing counts 0.
ErrorMetrics error_from_json(const nlohmann::ordered_json& json);
/// Reads the JSON written by cost_json(). Missing numbers become NaN, missing counts 0.
WorkCost cost_from_json(const nlohmann::ordered_json& json);
/// Returns the number in a field of a JSON object; NaN if missing or null.
double number_or_nan(const nlohmann::ordered_json& json, std::string_view field);

}  // namespace si
