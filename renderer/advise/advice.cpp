#include "renderer/advise/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "renderer/base/lengths_text.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/artefact_picture.h"

namespace si {
namespace {

bool is_faster(const Trial& t) {
    return t.ms && t.ms->is_significant() && t.ms->value < 0;
}

bool lowers_error(const Trial& t) {
    return t.added_error() < -t.least_gain();
}

/// Returns the reason why the error of a change refutes its rule's claim, whatever time it takes; empty: it does not.
std::string why_error_refutes(const Trial& t) {
    if (!t.is_drawn()) return t.candidate.untried;
    const double added = t.added_error();
    if (lowers_error(t)) return {};
    if (t.candidate.claim == Claim::Right) return fmt::format("the error does not fall ({:+.3g})", added);
    if (t.candidate.claim == Claim::Same && added > t.tolerance())
        return fmt::format("the error grows by {:.3g}", added);
    return {};
}

/// Returns the reason why a timed change is no advice; empty: it lowers the error, or keeps its rule's claim.
std::string why_no_advice(const Trial& t) {
    if (lowers_error(t) || is_faster(t)) return {};
    if (t.ms && t.ms->is_significant()) return fmt::format("a frame takes {} ms more", digits_text(t.ms->value));
    if (t.candidate.claim == Claim::Same && t.more_bytes() < 0) return {};
    return fmt::format("a frame takes no less time ({} ± {} ms)", signed_text(t.ms->value), digits_text(t.ms->noise));
}

/// Returns the rank of a measured change: its kind, then the values by which that kind is sorted, the least first.
std::tuple<int, double, double> rank_of(const Trial& t) {
    const double ms = t.ms ? t.ms->value : 0;
    if (!t.why_not.empty()) return {4, ms, 0};
    if (lowers_error(t)) return {0, t.added_error(), ms};
    if (is_faster(t) && t.added_error() <= t.tolerance()) return {1, ms, 0};
    if (is_faster(t)) return {2, ms / t.added_error(), 0};
    return {3, double(t.more_bytes()), 0};
}

Severity severity_of(double share) {
    return share >= 0.01 ? Severity::Error : share >= 0.001 ? Severity::Warning : Severity::Hint;
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

std::vector<Trial> try_advice(const Settings& settings, std::vector<Candidate> candidates, const TrialMeter& meter,
                              const TrialReport& report, const std::function<void(const std::vector<Trial>&)>& shown) {
    std::vector<Trial> tried;
    const auto rank = [&] {
        std::ranges::stable_sort(tried, {}, rank_of);
        if (shown) shown(tried);
    };
    std::map<int, MeasuredSettings> before;  // by light
    // A change whose error refutes its claim is not timed. One that lowers the error holds at any time: few rounds tell
    // its price.
    const auto time = [&](const Trial& t) {
        return lowers_error(t) ? meter.time_in_few_rounds(settings, t.candidate.settings)
                               : meter.time(settings, t.candidate.settings);
    };
    const auto rate = [&](Trial& t) {
        t.why_not = why_error_refutes(t);
        if (!t.why_not.empty()) return;
        if (!t.ms) t.ms = time(t);
        t.why_not = why_no_advice(t);
    };
    const bool ended = try_each(std::move(candidates), report, [&](Candidate& c) {
        const auto known = std::ranges::find_if(
            tried, [&](const Trial& t) { return t.candidate.light == c.light && t.candidate.settings == c.settings; });
        if (known != tried.end()) {
            if (known->why_not.empty() || !known->is_drawn()) return true;
            Trial again = *known;
            again.candidate = std::move(c);
            rate(again);
            // The change may hold under this weaker claim.
            if (again.why_not.empty()) *known = std::move(again);
            rank();
            return true;
        }
        if (!before.contains(c.light)) before[c.light] = meter.measure(settings, c.light);
        Trial t = try_candidate(settings, before[c.light], std::move(c), meter);
        rate(t);
        tried.push_back(std::move(t));
        rank();
        return true;
    });
    if (!ended && tried.empty()) throw Cancelled();
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
        if (const Trial* fix = fixes.fix_of(style.artefact)) {
            finding.fix =
                fmt::format("{} puts {} of them right; {} px are wrong then instead of {}", fix->candidate.name,
                            fix->cured_of[std::size_t(style.artefact)], wrong_pixels(fix->metrics), fixes.wrong);
            finding.settings = fix->changes;
        } else if (fixes.drawn() > 0) {
            finding.fix = fmt::format("none of {} changes puts some right and makes nothing worse", fixes.drawn());
        }
        out.push_back(std::move(finding));
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
    return out;
}

AdviceReport find_advice(const SearchTools& whole, const Settings& settings, const AdviceOptions& options,
                         const std::function<void(const AdviceReport&)>& shown) {
    constexpr double kFacts = 0.05;  // share of the whole
    const double begun = options.fixes ? 0.5 : kFacts;
    const SearchTools tools = whole.part();
    const Settings base = measured_settings(settings);
    AdviceReport out;
    out.options = options;
    tools.report(0, "the present settings");
    out.facts = advice_facts(tools, base);
    const TrialMeter meter = renderer_trial_meter(tools, {.error = options.error, .cost = options.cost});
    out.before = meter.measure(base, base.view.light);
    out.before.frame.reset();
    out.time = Measurer(tools.renderer, tools.width, tools.height, tools.workers)
                   .time(tools.scene, base, options.cost, {.most = 15, .bursts = kMinBursts, .over_s = 0.3});
    FixTable fixes;
    const auto show_fixes = [&](const FixTable& table) {
        out.findings = list_findings(out.facts, table);
        if (shown) shown(out);
    };
    if (options.fixes) fixes = find_fixes(tools.part(kFacts, begun), base, {}, show_fixes);
    show_fixes(fixes);
    const auto take = [&](const std::vector<Trial>& tried) {
        out.holds.clear();
        out.fails.clear();
        for (const Trial& t : tried) (t.why_not.empty() ? out.holds : out.fails).push_back(t);
        if (shown) shown(out);
    };
    out.stopped = fixes.stopped;
    if (out.stopped) return out;
    // Fixes of the picture and of each cause are advice, too.
    std::vector<Candidate> candidates = advice_candidates(base, out.facts);
    for (const ArtefactStyle& style : artefact_styles())
        if (const Trial* fix = fixes.fix_of(style.artefact)) candidates.push_back(fix->candidate);
    if (fixes.fix()) candidates.push_back(fixes.fix()->candidate);
    out.refused = fixes.refused + remove_refused(candidates, tools.engine, base);
    try {
        take(try_advice(base, std::move(candidates), meter, tools.part(begun, 1).report, take));
    } catch (const Cancelled&) {
        // The findings stay.
    }
    out.stopped = tools.workers.stop.stop_requested();
    return out;
}

}  // namespace si
