#include "app/sweep/tuning.h"

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/measure/axes.h"
#include "renderer/measure/measure.h"

namespace si {
namespace {

/// Returns the settings that a frame really draws, after repairs such as a resolution that the driver lacks. The search
/// starts from them.
Settings as_drawn(Renderer& renderer, const Scene& scene, const TuningJob& job) {
    Settings s = measured_settings(job.settings);
    const FrameResult frame = renderer.render(
        scene, s, {.width = job.width, .height = job.height, .outputs = {.colour = false, .visibility = true}});
    s.map.resolution = frame.map_resolution;
    if (const std::string why = reason_not_tunable(frame.lights, s.view.light); !why.empty()) throw Error(why);
    return s;
}

}  // namespace

Tuner run_tuning(Renderer& renderer, const Scene& scene, const TuningJob& job, const Workers& workers,
                 const std::function<void(const Tuner&)>& report) {
    const Settings start = as_drawn(renderer, scene, job);
    const FrameRequest request{.width = job.width, .height = job.height};
    TuneGoals goals = job.goals;
    goals.max_resolution = std::min(goals.max_resolution, renderer.driver().max_texture_size);
    Tuner tuner(start, goals);
    ReferenceCache cache;
    const ReferenceOptions reference = reference_options(start);
    Measurer clock(renderer, job.width, job.height);
    while (tuner.action() != Tuner::Action::None) {
        report(tuner);
        if (workers.stop.stop_requested()) throw Cancelled();
        const Settings s = tuner.settings();
        if (tuner.action() == Tuner::Action::Time) {
            tuner.add_time(clock.time(scene, s, goals.cost, {.bursts = kMinBursts, .over_s = 0.3}).total_ms.median);
            continue;
        }
        const MeasuredError measured =
            measure_error(renderer, scene, s, request, start.view.light, reference, cache, workers);
        tuner.add_trial(measure_bias_trial(measured, s, renderer.driver()));
    }
    return tuner;
}

void apply_tuning(Settings& settings, const Settings& found) {
    settings.bias = found.bias;
    settings.filter = found.filter;
    settings.map.resolution = found.map.resolution;
}

}  // namespace si
