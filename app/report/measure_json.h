// Errors, times and costs as JSON, shared by `measure --json` and the results of sweeps.
#pragma once

#include <string_view>

#include "app/base/json_text.h"
#include "renderer/bundle/engine_bias.h"
#include "renderer/measure/time_sampler.h"
#include "renderer/reference/metrics.h"

namespace si {

/// Converts the source of an engine's bias to JSON: "file" (the engine's bundle states it) or "entered" (by the user).
/// Null if the bias is unknown, or if Shadow Inspector itself draws the map.
nlohmann::ordered_json engine_bias_source_json(EngineBias bias);
/// Converts the distribution of a measured time to JSON {median, p95, low, high, median_low, median_high, noise}. The
/// noise is half the confidence interval of the median.
nlohmann::ordered_json spread_json(const Spread& spread);
/// Converts a measured frame time, with the times of its passes, to JSON.
nlohmann::ordered_json time_json(const TimeMeasurement& time);
/// Returns the name in JSON of a pixel's state: whether it counts in comparisons with the reference, or why not.
const char* state_key(PixelState state);
/// Converts the quality of a ray-traced reference to JSON. Members: area, step, noise, noise_unknown_px, samples_used
/// {least, mean, most}. Unknown values are null.
nlohmann::ordered_json reference_quality_json(const Reference& reference);
/// Version of the definitions of error shares and causes (JSON field `meaning`). Numbers of different versions must not
/// be compared. 1: by distance to a true edge. 2: by the change that makes a pixel right. 3: as 2, with polygon offset
/// and contact shadows as separate causes. 4: as 3, with light bleeding as a cause, and shadow terminators as a state.
inline constexpr int kErrorMeaning = 4;
/// Converts the error metrics of a picture to JSON. Numbers that are not finite become null.
nlohmann::ordered_json error_json(const ErrorMetrics& metrics);
/// Converts the error metrics of a picture to JSON, with the noise of the ray-traced reference. @param noise
/// Reference::noise
nlohmann::ordered_json error_json(const ErrorMetrics& metrics, double noise);
/// Converts the work of a frame to JSON: texels, taps and bytes of its shadow maps, draws and triangles.
nlohmann::ordered_json cost_json(const WorkCost& cost);
/// Parses the error metrics of a picture from the JSON that error_json() makes. Missing numbers become NaN, missing
/// counts 0.
ErrorMetrics error_from_json(const nlohmann::ordered_json& json);
/// Parses the work of a frame (texels, taps, bytes, draws, triangles) from the JSON that cost_json() makes. Missing
/// members become 0.
WorkCost cost_from_json(const nlohmann::ordered_json& json);
/// Returns the number in a field of a JSON object; NaN if the field is missing or no number.
double number_or_nan(const nlohmann::ordered_json& json, std::string_view field);

}  // namespace si
