// The cheapest set of effects that keeps an error, or the most accurate within a time: kernels, resolutions and what
// else the facts of a scene leave to choose, judged by truth and clock.
//
//     AutopilotResult r = run_autopilot(settings, autopilot_axes(settings, facts), {.max_error = 0.01}, meter);
//     if (r.held) use(r.best.settings); else tell(r.summary);
#pragma once

#include <optional>

#include "renderer/advise/advice.h"
#include "renderer/measure/axes.h"

namespace si {

struct AutopilotGoals {
    std::optional<double> max_error, max_ms;   ///< one of them at least
    const Metric* error = &metrics().front();  ///< one that has a better
    CostCase cost = kDefaultCost;              ///< which frames max_ms bounds
    double max_seconds = 100;                  ///< from then on nothing more is tried or priced
    std::size_t max_combinations = 160;        ///< more are not all tried, but searched by parts
};

/// An empty value: as the settings are. The first of each axis is that.
std::vector<SweepAxis> autopilot_axes(const Settings& settings, const AdviceFacts& facts, int most_resolution = 8192);

struct AutopilotMeter : AdviceMeter {
    std::function<double(const Settings&)> ms;  ///< of a frame
    std::function<double()> now_s;              ///< by any clock
};

struct AutopilotCase {
    std::vector<std::size_t> at;  ///< a value of each axis
    Settings settings;
    MeasuredSettings classified;
    std::optional<double> ms;  ///< of a frame, where it was needed
    bool holds = false;        ///< the bounds, as far as it was timed
};

/// What the settings had, and the best case has not.
struct DroppedEffect {
    std::string key, before, now;  ///< of the setting
    double error = 0;              ///< with it, all else as in the best case
    CostChange ms;                 ///< that it would have cost
};

struct AutopilotResult {
    bool held = false;
    AutopilotCase best;  ///< where nothing holds the bounds: what came nearest
    MeasuredSettings before;
    double before_ms = 0;
    std::vector<AutopilotCase> cases;    ///< all that were judged
    std::vector<DroppedEffect> dropped;  ///< those that there was time to price
    std::size_t combinations = 0;        ///< that the axes make
    std::vector<std::string> untried;    ///< in sentences
    std::string summary;                 ///< one
    double seconds = 0;
};

/// @param report hears of the share done and what is tried; may throw Cancelled
AutopilotResult run_autopilot(const Settings& settings, const std::vector<SweepAxis>& axes, const AutopilotGoals& goals,
                              const AutopilotMeter& meter,
                              const std::function<void(double, const std::string&)>& report = {});

/// As the renderer draws, on its thread, with axes of the facts unless some are given. @throws Cancelled; Error when
/// there is no light to judge
AutopilotResult run_rendered_autopilot(Renderer& renderer, const Scene& scene, const Settings& settings, int width,
                                       int height, const AutopilotGoals& goals, std::vector<SweepAxis> axes,
                                       ReferenceCache& cache, const Workers& workers = {},
                                       const std::function<void(double, const std::string&)>& report = {});

}  // namespace si
