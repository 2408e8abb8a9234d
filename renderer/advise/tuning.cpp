#include "renderer/advise/tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "renderer/settings/filters.h"

namespace si {
namespace {

constexpr int kMinResolution = 256;   // texels per side
constexpr int kMaxResolution = 8192;  // texels per side

std::vector<SweepAxis> tuned_axes(const Settings& start, int max_resolution) {
    std::vector<SweepAxis> axes = {{"filter.kernel", {""}}, {"map.resolution", {""}}};
    for (const std::string_view kernel : sweep_kernels()) axes[0].values.emplace_back(kernel);
    for (int n = std::min(kMinResolution, max_resolution); n <= max_resolution; n *= 2)
        if (n != start.map.resolution) axes[1].values.push_back(std::to_string(n));
    return axes;
}

}  // namespace

Tuned tune(const SearchTools& tools, const Settings& settings, const TuneGoals& goals, const FoundBiasShown& shown) {
    const double first = goals.any() ? 0.2 : 1;
    Tuned out;
    const Settings start = measured_settings(settings);
    out.bias = find_least_bias(tools.part(0, first), start, goals.max_gap_m, shown);
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
    const int largest = std::min(kMaxResolution, tools.renderer.driver().max_texture_size);
    out.limits = run_rendered_autopilot(tools.part(first, 1), with, limits, tuned_axes(with, largest));
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
