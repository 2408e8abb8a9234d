#include "renderer/advise/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "renderer/base/lengths_text.h"
#include "renderer/inspect/given_map_changes.h"
#include "renderer/measure/axes.h"
#include "renderer/settings/starting_values.h"

namespace si {
namespace {

constexpr int kMinRounds = 3;
constexpr int kMaxRounds = 8;
constexpr int kRoundFrames = 2;
constexpr double kMaxSeconds = 1;           // for one comparison of two settings
constexpr double kMaxRelativeNoise = 0.01;  // share of the frame time below which a comparison ends

double mean_of(const std::vector<double>& values) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return values.empty() ? 0 : sum / double(values.size());
}

/// Returns the work of a frame of which only the lights' maps are known.
WorkCost map_cost(const Settings& s, const MeasuredError& measured) {
    FrameResult maps;
    maps.lights = measured.lights;
    maps.map_resolution = measured.map_resolution;
    maps.map_size = measured.map_size;
    return work_cost(s, maps);
}

/// Returns true when a trial would change how a map is drawn that an engine has drawn.
bool changes_given_map(const MeasuredSettings& before, const Trial& t) {
    return has_imported_maps(before, t.candidate.light) &&
           std::ranges::any_of(t.changes, [](const auto& change) { return acts_while_drawing(change.first); });
}

}  // namespace

SearchTools SearchTools::part(double lo, double hi) const {
    SearchTools out = *this;
    out.workers = workers.with_progress_range(0, 0);
    out.report = [whole = report, stop = workers.stop, lo, hi](double share, const std::string& step) {
        if (whole) whole(lo + (hi - lo) * share, step);
        if (stop.stop_requested()) throw Cancelled();
    };
    return out;
}

AlternatingTimes time_alternately(const std::function<double()>& before, const std::function<double()>& with,
                                  const std::stop_token& stop, std::optional<double> limit_ms) {
    std::vector<double> more, base;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kMaxRounds; ++i) {
        if (stop.stop_requested()) throw Cancelled();
        const bool there = i % 2 == 0;
        const double a = there ? before() : 0, b = with(), c = there ? a : before();
        base.push_back(c);
        more.push_back(b - c);
        const double noise = half_interval(more), value = mean_of(more);
        const bool sharp = noise < kMaxRelativeNoise * mean_of(base) || std::abs(value) > 2 * noise ||
                           (limit_ms && std::abs(value - *limit_ms) > 2 * noise);
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        if (i + 1 >= kMinRounds && (sharp || spent.count() > kMaxSeconds)) break;
    }
    return {mean_of(base), {mean_of(more), half_interval(more)}};
}

SettingChanges setting_changes(const Settings& base, const Settings& with) {
    SettingChanges out;
    for (const SettingRef& ref : settings_to_set(base, with))
        out.emplace_back(setting_key(ref), value_text(*ref.param, get_value(with, ref)));
    return out;
}

std::string time_text(const std::optional<CostChange>& ms) {
    if (!ms) return "-";
    return ms->is_significant() ? signed_text(ms->value) + " ms" : "< noise";
}

std::string map_bytes_text(long long bytes) {
    if (bytes == 0) return "same";
    const bool large = std::abs(bytes) >= 1 << 20;
    return fmt::format("{:+.0f} {}", double(bytes) / (large ? 1 << 20 : 1 << 10), large ? "MiB" : "KiB");
}

bool has_imported_maps(const MeasuredSettings& measured, int light) {
    const auto i = std::size_t(std::max(light, 0));
    return measured.frame && i < measured.frame->lights.size() &&
           measured.frame->lights[i].provider == MapProvider::Imported;
}

std::size_t wrong_pixels(const ErrorMetrics& error) {
    return std::accumulate(error.artefacts.begin() + 1, error.artefacts.end(), error.without_cause);
}

bool Trial::helps() const {
    return is_drawn() && (why_not.empty() || (added_error() < 0 && pixel.value_or(PixelTrial()).right));
}

double Trial::tolerance() const {
    const double noise = std::isfinite(before.noise) ? before.noise : 0;
    return std::max({kSameErrorShare * before.error, kSameError, noise / 10});
}

double Trial::least_gain() const {
    const double noise = std::isfinite(before.noise) ? before.noise : 0;
    return std::max(kSameError, 2 * noise / std::sqrt(std::max<double>(double(metrics.counted), 1)));
}

std::size_t remove_refused(std::vector<Candidate>& list, const EngineProfile* engine, const Settings& base) {
    if (!engine) return 0;
    return std::erase_if(list,
                         [&](const Candidate& c) { return !reason_engine_lacks(*engine, base, c.settings).empty(); });
}

PixelTrial pixel_trial(const MeasuredError& with, std::size_t pixel) {
    const ClassifiedPixel& classified = with.classified[pixel];
    return {classified.visibility, with.traced.reference->visibility.data[pixel], !classified.is_wrong()};
}

Trial try_candidate(const Settings& base, const MeasuredSettings& before, Candidate candidate, const TrialMeter& meter,
                    std::optional<std::size_t> pixel, const NeedsCauses& needs_causes) {
    Trial t{.candidate = std::move(candidate), .changes = {}, .before = before, .after = {}};
    t.changes = setting_changes(base, t.candidate.settings);
    t.before.frame.reset();
    if (t.is_drawn() && changes_given_map(before, t)) t.candidate.untried = kNeedsAnotherMap;
    if (!t.is_drawn()) return t;
    t.after = needs_causes && meter.measure_in_steps
                  ? meter.measure_in_steps(t.candidate.settings, t.candidate.light, needs_causes)
                  : meter.measure(t.candidate.settings, t.candidate.light);
    const auto with = std::exchange(t.after.frame, nullptr), was = before.frame;
    if (before.camera.eye != t.after.camera.eye ||
        before.camera.clip_from_relative(before.camera.eye) != t.after.camera.clip_from_relative(t.after.camera.eye))
        t.candidate.untried = "the camera looks through this light and would move with it";
    if (!with || !was) return t;
    if (with->map_resolution != t.candidate.settings.map.resolution &&
        t.candidate.settings.map.resolution != base.map.resolution)
        t.candidate.untried =
            fmt::format("maps of that size need too much memory; {}² would be drawn", with->map_resolution);
    if (with->traced.reference->visibility.data != was->traced.reference->visibility.data)
        t.candidate.untried = "the reference would change";
    t.metrics = with->metrics;
    for (std::size_t i = 0; i < was->classified.size(); ++i) {
        const Artefact cause = was->classified[i].artefact;
        const bool is_wrong = with->classified[i].is_wrong();
        if (cause != Artefact::None && !is_wrong) {
            ++t.cured;
            ++t.cured_of[std::size_t(cause)];
        }
        t.broken += cause == Artefact::None && is_wrong;
    }
    if (pixel) t.pixel = pixel_trial(*with, *pixel);
    return t;
}

TrialMeter renderer_trial_meter(const SearchTools& tools, const TrialOptions& options) {
    const FrameRequest request{.width = tools.width, .height = tools.height};
    TrialMeter meter;
    meter.measure_in_steps = [=](const Settings& s, int light, const NeedsCauses& needs_causes) {
        const auto& workers = tools.workers;
        if (workers.stop.stop_requested()) throw Cancelled();
        FrameRequest own = request;
        trace_sources(tools.renderer, tools.scene, s, own, tools.cache, workers);
        const Metric& metric = *options.error;
        const auto m = std::make_shared<const MeasuredError>(
            measure_error(tools.renderer, tools.scene, s, own, light, options.reference.value_or(reference_options(s)),
                          tools.cache, workers, metric.of_pictures, needs_causes));
        own.force = true;
        return MeasuredSettings{
            distance_from_best(metric.better, metric.value(m->metrics)), m->traced.reference->noise,
            options.work ? work_cost(s, tools.renderer.render(tools.scene, s, own)) : map_cost(s, *m), m->camera, m};
    };
    meter.measure = [measure = meter.measure_in_steps](const Settings& s, int light) { return measure(s, light, {}); };
    const auto timed = [=](const Settings& before, const Settings& with, std::optional<double> limit_ms) {
        const auto rounds = [&](const Settings& s) {
            const auto frames = std::make_shared<TimedFrames>(tools.renderer, tools.scene, s, request, options.cost,
                                                              tools.cache, tools.workers);
            return [frames, begun = false]() mutable {
                // One frame makes the cached results valid again, once programs are compiled.
                if (std::exchange(begun, true))
                    frames->draw_next();
                else
                    frames->warm_up();
                TimeSamples samples;
                for (int i = 0; i < kRoundFrames; ++i) samples.add(frames->draw_next());
                // Other work of the machine only lengthens frames. Now and then one takes half as long again.
                return *std::ranges::min_element(samples.total_ms);
            };
        };
        return time_alternately(rounds(before), rounds(with), tools.workers.stop, limit_ms).more;
    };
    meter.time = [=](const Settings& before, const Settings& with) { return timed(before, with, {}); };
    meter.time_to_limit = [=](const Settings& before, const Settings& with, double limit_ms) {
        return timed(before, with, limit_ms);
    };
    meter.map_bytes = [=](const Settings& s) {
        FrameRequest plan = request;
        plan.outputs = {.colour = false};
        return work_cost(s, tools.renderer.render(tools.scene, s, plan)).map_bytes;
    };
    meter.ms = [=](const Settings& s) {
        const Spread time =
            Measurer(tools.renderer, tools.width, tools.height, tools.workers)
                .time(tools.scene, s, options.cost, {.least = 3, .most = 6, .bursts = 2, .over_s = 0.15})
                .total_ms;
        return CostChange{time.median, time.noise()};
    };
    meter.now_s = BurstClock::steady().now_s;
    meter.draw = [=](const Candidate& c, FrameRequest own) {
        if (tools.workers.stop.stop_requested()) throw Cancelled();
        own.emptied = c.emptied;
        return tools.renderer.render(c.scene ? *c.scene : tools.scene, c.settings, own);
    };
    return meter;
}

}  // namespace si
