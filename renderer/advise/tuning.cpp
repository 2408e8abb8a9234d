#include "renderer/advise/tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "renderer/settings/filters.h"

namespace si {
namespace {

constexpr int kMinResolution = 256;

std::vector<SweepAxis> tuned_axes(const Settings& start, int max_resolution) {
    std::vector<SweepAxis> axes = {{"filter.kernel", {""}}, {"map.resolution", {""}}};
    for (const std::string_view kernel : sweep_kernels()) axes[0].values.emplace_back(kernel);
    for (int n = std::min(kMinResolution, max_resolution); n <= max_resolution; n *= 2)
        if (n != start.map.resolution) axes[1].values.push_back(std::to_string(n));
    return axes;
}

}  // namespace

Tuned tune(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
           const TuneGoals& goals, ReferenceCache& cache, const Workers& workers, const TrialReport& report,
           const FoundBiasShown& shown) {
    const double first = goals.any() ? 0.2 : 1;
    const auto part = [&](double from, double to) {
        return [&report, from, to](double share, const std::string& step) {
            if (report) report(from + (to - from) * share, step);
        };
    };
    Tuned out;
    const Settings start = measured_settings(settings);
    const LeastBiasOptions options{.max_gap_m = goals.max_gap_m, .reference = reference_options(start)};
    out.bias = find_least_bias(renderer, scene, start, width, height, options, cache, workers, part(0, first), shown);
    out.summary = out.bias.summary(goals.no_acne);
    const TriedBias* found = goals.no_acne ? out.bias.best_without_acne() : out.bias.best();
    if (!found && out.bias.before.needs.pixels > 0) return out;
    Settings with = start;
    if (found) with.bias = found->bias;
    if (!goals.any()) {
        if (found) out.result = with;
        return out;
    }
    if (out.bias.stopped) return out;
    const AutopilotGoals limits{.max_error = goals.max_error,
                                .max_ms = goals.max_ms,
                                .error = goals.error,
                                .cost = goals.cost,
                                .max_seconds = std::numeric_limits<double>::infinity(),
                                .max_combinations = std::numeric_limits<std::size_t>::max()};
    const int largest = std::min(goals.max_resolution, renderer.driver().max_texture_size);
    out.limits = run_rendered_autopilot(renderer, scene, with, width, height, limits, tuned_axes(with, largest), cache,
                                        workers, part(first, 1));
    out.summary = fmt::format("{}; {}", out.limits->summary, out.summary);
    if (out.limits->goals_met) out.result = out.limits->best.settings;
    return out;
}

void apply_tuning(Settings& settings, const Settings& found) {
    settings.bias = found.bias;
    settings.filter = found.filter;
    settings.map.resolution = found.map.resolution;
}

}  // namespace si
