// Error, cost and shimmer along a path on which a light moves, while the camera stands still.
//
//     LightPath path = straight_path("light.azimuth=0:90,light.elevation=10:60", 12, settings);
//     LightPathResult r = measure_light_path(renderer, scene, settings, 640, 360, path, {}, {}, report, show);
//     r.steps[i].error.mae, r.steps[i].change->beyond
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/measure/measure.h"

namespace si {

/// Point of a light's path: the settings of lights that change along the path, with their values.
struct PathPoint {
    std::vector<std::pair<std::string, std::string>> values;  ///< setting key and value
    std::optional<double> hour = {};  ///< solar time, hours since midnight; none: not a path of the sun
    bool operator==(const PathPoint&) const = default;
};

/// Path along which a light moves, as a list of points to measure.
struct LightPath {
    std::string about;  ///< "light.azimuth=0:90" or "the sun at latitude 48, day 172"
    std::vector<PathPoint> points;
};

/// Default number of points on a light's path.
inline constexpr int kPathSteps = 12;
/// Largest number of points on a light's path.
inline constexpr int kMaxPathSteps = 1000;

/// Makes a path on which settings of lights, such as azimuth and elevation, change together from their first to their
/// last values, both included.
/// @param text "KEY=from:to,KEY=from:to" (the option --along) @param steps number of points, at least 2
/// @throws UsageError for text in another form, a key that is not a numeric setting of a light, a key without effect,
/// or a value out of range
LightPath straight_path(std::string_view text, int steps, const Settings& settings);

/// Makes the path of the sun over a day for the directional light that view.light selects, from sunrise to sunset.
/// @param text "LATITUDE,DAY" (the option --day): degrees, north positive; day of the year from 1
/// @param steps number of points
/// @throws UsageError for text in another form, a polar night, or a light that is not directional
LightPath day_path(std::string_view text, int steps, const Settings& settings);

/// Returns a copy of the settings with the light at a point of its path.
Settings settings_at(Settings settings, const PathPoint& point);

/// Change of visibility from one point of a light's path to the next, over pixels that the error metrics count at both
/// points. V is the visibility in the picture, R that in the reference.
struct PathChange {
    std::size_t pixels = 0;  ///< number of pixels counted at both points
    double drawn = 0;        ///< mean of |change of V|
    double reference = 0;    ///< mean of |change of R|
    double beyond = 0;       ///< mean of max(|change of V| - |change of R|, 0): shimmer
    std::size_t flips = 0;   ///< number of pixels whose V crosses one half while R stays on its side
};

/// Compares the change of visibility between two points of a light's path with the change in the reference (ray-traced
/// shadows). Change beyond that of the reference is shimmer.
/// @param before, now pixels at the two points, same camera and size
/// @throws Error when sizes differ
PathChange path_change(const std::vector<ClassifiedPixel>& before, const Reference& reference_before,
                       const std::vector<ClassifiedPixel>& now, const Reference& reference_now);

/// Measurement at one point of a light's path: shadow error, work of the frame (WorkCost), time, and change since the
/// point before.
struct PathStep {
    PathPoint point;
    ErrorMetrics error;
    WorkCost cost;
    std::optional<TimeMeasurement> time;
    std::optional<PathChange> change;  ///< change from the point before; none at the first point
};

/// Options for measuring shadows along a light's path.
struct LightPathOptions {
    bool time = true;              ///< true: frames are timed
    CostCase cost = kDefaultCost;  ///< kind of frames to time
};

/// Measurements of shadows along a light's path, one step for each point.
struct LightPathResult {
    LightPath path;
    std::vector<PathStep> steps;  ///< one per measured point; fewer than the path's points until all are measured
    std::string clock;            ///< clock of the times; empty: not timed
    CostCase cost = kDefaultCost;
    /// Returns the index of the measured point of a light's path that has the largest error by a metric. Leaves out
    /// points where the metric is NaN; 0 when no point is left.
    std::size_t worst(const Metric& metric) const;
};

/// Measures shadow error and work of the frame (WorkCost: texels, draw calls, triangles) at every point of a light's
/// path in order. Measures frame time on request.
/// @param report receives the share done, 0..1, and the values of the next point
/// @param show receives the results so far, after each point @throws Cancelled, Error
LightPathResult measure_light_path(Renderer& renderer, const Scene& scene, const Settings& settings, int width,
                                   int height, const LightPath& path, const LightPathOptions& options,
                                   const Workers& workers,
                                   const std::function<void(double, const std::string&)>& report,
                                   const std::function<void(const LightPathResult&)>& show = {});

}  // namespace si
