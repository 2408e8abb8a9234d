#include "renderer/advise/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "renderer/base/lengths_text.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/artefact_picture.h"

namespace si {
namespace {

constexpr int kMinRounds = 3;
constexpr int kMaxRounds = 8;
constexpr int kRoundFrames = 2;
constexpr double kMaxSeconds = 2;           // for one comparison of two settings
constexpr double kMaxRelativeNoise = 0.01;  // share of the frame time below which a comparison ends

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return values.empty() ? 0 : sum / double(values.size());
}

/// Times frames of two settings in alternating rounds, so that drift of the machine's speed affects both alike.
CostChange difference_of(TimedFrames before, TimedFrames with, const Workers& workers) {
    const auto round = [&](TimedFrames& frames) {
        frames.warm_up();
        TimeSamples samples;
        for (int i = 0; i < kRoundFrames; ++i) samples.add(frames.draw_next());
        return mean_of(samples.total_ms);
    };
    round(before);
    round(with);  // programs are compiled
    std::vector<double> more, base;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kMaxRounds; ++i) {
        if (workers.stop.stop_requested()) throw Cancelled();
        const bool there = i % 2 == 0;
        const double a = there ? round(before) : 0, b = round(with), c = there ? a : round(before);
        base.push_back(c);
        more.push_back(b - c);
        const double noise = half_interval(more), value = mean_of(more);
        const bool sharp = noise < kMaxRelativeNoise * mean_of(base) || std::abs(value) > 2 * noise;
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        if (i + 1 >= kMinRounds && (sharp || spent.count() > kMaxSeconds)) break;
    }
    return {mean_of(more), half_interval(more)};
}

std::string verdict(const TriedAdvice& t) {
    if (!(t.before.camera == t.after.camera)) return "the camera looks through this light and would move with it";
    const double added = t.added_error();
    const bool faster = t.ms.is_significant() && t.ms.value < 0, slower = t.ms.is_significant() && t.ms.value > 0;
    if (t.idea.claim == Claim::Right)
        return added < -t.tolerance() ? "" : fmt::format("the error does not fall ({:+.3g})", added);
    if (t.idea.claim == Claim::Same && added > t.tolerance()) return fmt::format("the error grows by {:.3g}", added);
    if (slower) return fmt::format("a frame takes {} ms more", digits_text(t.ms.value));
    if (faster) return {};
    if (t.idea.claim == Claim::Same && t.more_bytes() < 0) return {};
    return fmt::format("a frame takes no less time ({} ± {} ms)", signed_text(t.ms.value), digits_text(t.ms.noise));
}

/// Returns the rank of a measured change: its kind, then the value by which that kind is sorted, the least first.
std::pair<int, double> rank_of(const TriedAdvice& t) {
    if (!t.why_not.empty()) return {4, t.ms.value};
    const bool faster = t.ms.is_significant() && t.ms.value < 0;
    if (faster && t.added_error() <= t.tolerance()) return {0, t.ms.value};
    if (faster) return {1, t.ms.value / t.added_error()};
    if (t.added_error() < -t.tolerance()) return {2, t.added_error()};
    return {3, double(t.more_bytes())};
}

Severity severity_of(double share) {
    return share >= 0.01 ? Severity::Error : share >= 0.001 ? Severity::Warning : Severity::Hint;
}

/// Returns the fix that puts most pixels of a cause right, among fixes that put more right in all than they break;
/// nullptr if there is none.
const MeasuredFix* best_fix(const FixTable& fixes, Artefact artefact) {
    const MeasuredFix* best = nullptr;
    const auto of = [&](const MeasuredFix& c) { return c.cured_of[std::size_t(artefact)]; };
    for (const MeasuredFix& c : fixes.rows)
        if (c.untried.empty() && c.gain() > 0 && of(c) > 0 && (!best || of(c) > of(*best))) best = &c;
    return best;
}

void add_limits(const FittedLight& light, int number, std::vector<Finding>& out) {
    if (!light.casts) return;
    if (light.limits.one_depth_step)
        out.push_back({Severity::Error,
                       fmt::format("light {}: all depth lies in one step of the map's format", number),
                       "a finer map.format, or near and far planes nearer to the casters",
                       {}});
    if (light.limits.one_texel)
        out.push_back({Severity::Error,
                       fmt::format("light {}: a texel is wider than the scene", number),
                       "a light.extent that fits the scene, or light.fit casters",
                       {}});
    if (light.clipped_casters > 0)
        out.push_back(
            {Severity::Warning,
             fmt::format("light {}: {} casters reach in front of the near plane", number, light.clipped_casters),
             "light.near_far pancaking, or a smaller light.near",
             {}});
}

}  // namespace

double TriedAdvice::tolerance() const {
    const double noise = std::isfinite(before.noise) ? before.noise : 0;
    return std::max({kSameErrorShare * before.error, kSameError, noise / 10});
}

std::vector<TriedAdvice> measure_ideas(const Settings& settings, std::vector<AdviceIdea> ideas,
                                       const AdviceMeter& meter,
                                       const std::function<void(double, const std::string&)>& report) {
    std::vector<TriedAdvice> tried;
    std::map<int, MeasuredSettings> before;  // by light
    for (std::size_t i = 0; i < ideas.size(); ++i) {
        if (report) report(double(i) / double(ideas.size()), ideas[i].sentence);
        const int light = ideas[i].light;
        if (!before.contains(light)) before[light] = meter.classify(settings, light);
        TriedAdvice t{
            .idea = std::move(ideas[i]), .settings = {}, .before = before[light], .after = {}, .ms = {}, .why_not = {}};
        const auto known = std::find_if(tried.begin(), tried.end(), [&](const TriedAdvice& other) {
            return other.idea.light == light && other.idea.settings == t.idea.settings;
        });
        if (known != tried.end()) {
            if (known->why_not.empty()) continue;
            TriedAdvice again = *known;
            again.idea = std::move(t.idea);
            again.why_not = verdict(again);
            // The change may hold under this weaker claim.
            if (again.why_not.empty()) *known = std::move(again);
            continue;
        }
        t.settings = setting_changes(settings, t.idea.settings);
        t.after = meter.classify(t.idea.settings, light);
        t.ms = meter.time(settings, t.idea.settings);
        t.why_not = verdict(t);
        tried.push_back(std::move(t));
    }
    std::stable_sort(tried.begin(), tried.end(),
                     [](const TriedAdvice& a, const TriedAdvice& b) { return rank_of(a) < rank_of(b); });
    return tried;
}

std::string_view severity_key(Severity severity) {
    static constexpr std::string_view kWords[] = {"error", "warning", "hint"};
    return kWords[std::size_t(severity)];
}

std::vector<Finding> list_findings(const AdviceFacts& facts, const FixTable& fixes) {
    std::vector<Finding> out;
    if (facts.pixels == 0)
        out.push_back({Severity::Warning,
                       fmt::format("no pixel of the picture faces light {}", facts.light),
                       "another camera, or another view.light",
                       {}});
    for (std::size_t i = 0; i < facts.lights.size(); ++i) add_limits(facts.lights[i], int(i), out);
    for (const std::string& note : facts.notes) out.push_back({Severity::Warning, note, {}, {}});
    for (const ArtefactStyle& style : artefact_styles()) {
        const std::size_t pixels = facts.error.artefacts[std::size_t(style.artefact)];
        if (pixels == 0 || facts.error.counted == 0) continue;
        const double share = double(pixels) / double(facts.error.counted);
        Finding finding{severity_of(share),
                        fmt::format("{}: {} pixel{}, {} % of the counted ones", style.label, pixels,
                                    pixels == 1 ? "" : "s", digits_text(100 * share)),
                        {},
                        {}};
        if (const MeasuredFix* fix = best_fix(fixes, style.artefact)) {
            finding.fix = fmt::format("{} cures {} of them and breaks {} others", fix->name,
                                      fix->cured_of[std::size_t(style.artefact)], fix->broken);
            finding.settings = fix->settings;
        }
        out.push_back(std::move(finding));
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
    return out;
}

AdviceMeter renderer_advice_meter(Renderer& renderer, const Scene& scene, int width, int height,
                                  const AdviceOptions& options, ReferenceCache& cache, const Workers& workers) {
    const auto stop = [&] {
        if (workers.stop.stop_requested()) throw Cancelled();
    };
    const FrameRequest request{.width = width, .height = height};
    AdviceMeter meter;
    meter.classify = [=, &renderer, &scene, &cache, &workers](const Settings& s, int light) {
        stop();
        FrameRequest own = request;
        trace_sources(renderer, scene, s, own, cache, workers);
        const MeasuredError m = measure_error(renderer, scene, s, own, light, reference_options(s), cache, workers);
        own.force = true;
        const Metric& metric = *options.error;
        return MeasuredSettings{distance_from_best(metric.better, metric.value(m.metrics)), m.traced.reference->noise,
                                work_cost(s, renderer.render(scene, s, own)), m.camera};
    };
    meter.time = [=, &renderer, &scene, &cache, &workers](const Settings& before, const Settings& with) {
        const auto frames = [&](const Settings& s) {
            return TimedFrames(renderer, scene, s, request, options.cost, cache, workers);
        };
        return difference_of(frames(before), frames(with), workers);
    };
    return meter;
}

AdviceReport find_advice(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
                         const AdviceOptions& options, ReferenceCache& cache, const Workers& workers,
                         const std::function<void(double, const std::string&)>& report) {
    constexpr double kLooking = 0.1, kCuring = 0.2;  // shares of the whole
    const auto report_progress = [&](double share, const std::string& what) {
        if (workers.stop.stop_requested()) throw Cancelled();
        if (report) report(share, what);
    };
    const Settings base = measured_settings(settings);
    const Workers quiet = workers.with_progress_range(0, 0);
    AdviceReport out;
    out.options = options;
    report_progress(0, "the present settings");
    out.facts = advice_facts(renderer, scene, base, width, height, cache, quiet);
    const AdviceMeter meter = renderer_advice_meter(renderer, scene, width, height, options, cache, quiet);
    out.before = meter.classify(base, base.view.light);
    out.time = Measurer(renderer, width, height, quiet)
                   .time(scene, base, options.cost, {.most = 15, .bursts = kMinBursts, .over_s = 0.3});
    FixTable fixes;
    if (options.fixes)
        fixes = find_fixes(
            renderer, scene, base, width, height, {.reference = reference_options(base)}, cache, quiet,
            [&](double share, const std::string& what) { report_progress(kLooking + kCuring * share, what); });
    out.findings = list_findings(out.facts, fixes);
    const double begun = kLooking + (options.fixes ? kCuring : 0);
    for (TriedAdvice& t : measure_ideas(
             base, advice_ideas(base, out.facts), meter,
             [&](double share, const std::string&what) { report_progress(begun + (1 - begun) * share, what); }))
        (t.why_not.empty() ? out.holds : out.fails).push_back(std::move(t));
    return out;
}

}  // namespace si
