#include "renderer/advise/least_bias.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "renderer/base/lengths_text.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/distance_transform.h"
#include "renderer/settings/param.h"
#include "renderer/view/fits/engine_facts.h"
#include "renderer/view/fits/light_fit.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

constexpr double kScoreTie = 0.01;       // share of the score
constexpr double kErrorTie = 1e-3;       // share of the mean error
constexpr double kGapTie = 0.02;         // share of the gap
constexpr double kPlaneConstant = 0.25;  // texels
constexpr double kStronger[] = {2, 4};
constexpr double kWeaker[] = {0.5, 0.25, 1 / 8., 1 / 16., 1 / 32., 1 / 64.};
constexpr int kRises = 2;  // trials with a score above the least that end a direction: one may be chance
constexpr double kLargestStrength = 8;
// Multiples of the least score at which a row is given up: finer trials seldom gain more than half.
constexpr double kOutOfReach = 2, kOutOfReachAfterFine = 1.5;
constexpr int kFineToGiveUp = 3;  // finer trials after which the smaller multiple counts
constexpr int kBisections = 3;
constexpr int kFine = 5;  // trials between the neighbours of the best coarse strength

/// Returns pixels whose shadow in the reference is partial, or differs from that of a neighbour.
std::vector<std::uint8_t> shadow_edges(const Reference& reference) {
    const int w = reference.width, h = reference.height;
    const FloatImage& hard = reference.hard();
    std::vector<std::uint8_t> edge(reference.state.size());
    const auto differ = [&](std::size_t i, std::size_t k) {
        const bool counted = reference.state[i] == PixelState::Counted && reference.state[k] == PixelState::Counted;
        if (counted && (hard.data[i] < 0.5f) != (hard.data[k] < 0.5f)) edge[i] = edge[k] = 1;
    };
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(w) + std::size_t(x);
            const float v = reference.visibility.data[i];
            if (v > 0 && v < 1) edge[i] = 1;
            if (x + 1 < w) differ(i, i + 1);
            if (y + 1 < h) differ(i, i + std::size_t(w));
        }
    return edge;
}

/// Search of one row's strength with the least score.
class StrengthSearch {
public:
    StrengthSearch(const BiasStart& start, const BiasMeter& meter, FoundBias& out)
        : start_(start), meter_(meter), out_(out) {}

    void run() {
        if (!start_.has_strength()) {
            measure(1);
            return;
        }
        measure(1);
        measure(0);
        scan(kStronger);
        scan(kWeaker);
        const auto best = std::ranges::min_element(tried_, {}, score);
        if (out_of_reach(best->trial.score, kOutOfReach)) return;
        const double middle = best->strength;
        double lo = 0, hi = kLargestStrength;
        for (const TriedBias& t : tried_) {
            if (t.strength < middle) lo = std::max(lo, t.strength);
            if (t.strength > middle) hi = std::min(hi, t.strength);
        }
        // The golden section halves the range least often for its number of trials.
        constexpr double kGolden = 0.381966011250105;
        double at = middle, least = best->trial.score;
        for (int i = 0; i < kFine; ++i) {
            if (i == kFineToGiveUp && out_of_reach(least, kOutOfReachAfterFine)) return;
            const bool above = hi - at > at - lo;
            const double next = above ? at + kGolden * (hi - at) : at - kGolden * (at - lo);
            const double found = measure(next);
            if (found < least) {
                (above ? lo : hi) = at;
                at = next;
                least = found;
            } else {
                (above ? hi : lo) = next;
            }
        }
        find_weakest_without_acne();
    }

private:
    const BiasStart& start_;
    const BiasMeter& meter_;
    FoundBias& out_;
    std::vector<TriedBias> tried_;

    static double score(const TriedBias& t) { return t.trial.score; }
    /// Measures strengths in turn, until the score has risen twice from the least since strength 1. With a limit of the
    /// gap all are measured, since a strength with a larger score may be the first within it.
    void scan(std::span<const double> strengths) {
        double least = tried_.front().trial.score;
        int rises = 0;
        for (const double strength : strengths) {
            const double found = measure(strength);
            if (found < least) rises = 0;
            if (found > least * (1 + kScoreTie) + 0.5) ++rises;
            least = std::min(least, found);
            if (rises == kRises && !out_.max_gap_m) return;
        }
    }
    /// Returns true for scores over `times` the least one of trials that may be a result of either kind: without acne,
    /// and with no more wrong pixels than before.
    bool out_of_reach(double score, double times) const {
        if (out_.max_gap_m) return false;
        double least = std::numeric_limits<double>::infinity();
        for (const TriedBias& t : out_.tried)
            if (t.trial.has_no_acne() && wrong_pixels(t.trial.error) <= wrong_pixels(out_.before.error))
                least = std::min(least, t.trial.score);
        return score > times * least + 0.5;
    }
    /// Bisects between the weakest strength without acne and the next weaker one.
    void find_weakest_without_acne() {
        for (int i = 0; i < kBisections; ++i) {
            double clean = std::numeric_limits<double>::infinity(), acne = 0;
            for (const TriedBias& t : tried_)
                if (t.trial.has_no_acne()) clean = std::min(clean, t.strength);
            for (const TriedBias& t : tried_)
                if (t.strength < clean) acne = std::max(acne, t.strength);
            if (!std::isfinite(clean) || clean == 0 || clean - acne < 0.1 * clean) return;
            measure(0.5 * (clean + acne));
        }
    }
    /// Measures a strength unless it has been. Returns its score.
    double measure(double strength) {
        const BiasSettings bias = start_.at_strength(strength);
        const auto known = std::ranges::find(tried_, bias, &TriedBias::bias);
        if (known != tried_.end()) return known->trial.score;
        tried_.push_back({start_.row, strength, bias, meter_(bias)});
        out_.tried.push_back(tried_.back());
        return tried_.back().trial.score;
    }
};

std::string trial_text(const BiasTrial& before, const BiasTrial& after) {
    std::string text = fmt::format(
        "{} px wrong (was {}), acne {} px (was {}), gap at casters {} at the median, {} for 95 % (was {}, {})",
        wrong_pixels(after.error), wrong_pixels(before.error), after.acne(), before.acne(),
        metres_text(after.needs.gap_median_m), metres_text(after.needs.gap_p95_m),
        metres_text(before.needs.gap_median_m), metres_text(before.needs.gap_p95_m));
    if (after.needs.folds > 0)
        text += fmt::format("; {} px stay a little darker in concave corners", after.needs.folds);
    return text;
}

}  // namespace

std::size_t BiasTrial::lost() const {
    const auto pixels = [&](Artefact a) { return error.artefacts[std::size_t(a)]; };
    return pixels(Artefact::PeterPanning) + pixels(Artefact::PeterPanningOffset) +
           pixels(Artefact::PeterPanningRaster) + pixels(Artefact::OffsetShadow);
}

BiasScore::BiasScore(const MeasuredError& m, const Settings& settings) {
    const Reference& reference = *m.traced.reference;
    const FittedLight& light = m.lights[std::size_t(m.light)];
    const double reach_texels = edge_reach_texels(settings, light, m.map_size);
    const std::vector<float> distance_px = distance_to(shadow_edges(reference), reference.width, reference.height);
    near_edge_.resize(reference.state.size());
    for (std::size_t i = 0; i < near_edge_.size(); ++i) {
        if (reference.state[i] != PixelState::Counted || !std::isfinite(distance_px[i])) continue;
        const Receiver& r = m.traced.receivers->pixels[i];
        const LightReceiver at = receiver_in_light(m, settings, r);
        // A texel covers 1 / n.l of its width on the surface, and no more of the picture.
        const double reach_m = reach_texels * at.texel_m / std::max(at.n_dot_l, 1e-3);
        near_edge_[i] = distance_px[i] <=
                        1 + reach_m / pixel_m(m.camera, depth_along_axis_m(m.camera, r.position_ws), reference.height);
    }
}

double BiasScore::compute_score(const MeasuredError& m) const {
    const Reference& reference = *m.traced.reference;
    double sum = 0;
    for (std::size_t i = 0; i < near_edge_.size(); ++i) {
        if (reference.state[i] != PixelState::Counted) continue;
        if (m.classified[i].artefact != Artefact::None) sum += 1;
        if (near_edge_[i]) continue;
        const double error = std::abs(double(m.classified[i].visibility) - double(reference.visibility.data[i]));
        const double noise = reference.is_area() ? double(reference.standard_error.data[i]) : 0;
        if (error > 3 * noise) sum += error;
    }
    return sum;
}

std::vector<BiasStart> bias_starts(const MeasuredError& measured, const Settings& settings,
                                   const RasterTraits& driver) {
    std::vector<BiasStart> out;
    if (!has_lit_receivers(measured)) return out;
    for (const Bias& row : biases()) {
        std::optional<BiasSettings> least = least_bias_of_row(row, measured, settings, driver);
        if (!least) continue;
        const bool is_given = measured.lights[std::size_t(measured.light)].provider == MapProvider::Imported;
        if (is_given && (least->raster_slope != 0 || least->raster_units != 0)) continue;  // acts while maps are drawn
        if (row.gives_needed_bias && std::ranges::find(row.settings, "bias.constant") != row.settings.end())
            least->constant = kPlaneConstant;
        out.push_back({&row, *least});
    }
    // Rows that compute the needed bias by themselves come first: they take few trials.
    std::stable_partition(out.begin(), out.end(), [](const BiasStart& s) { return s.row->gives_needed_bias; });
    return out;
}

const TriedBias* FoundBias::least_score(const Bias* row, bool no_acne) const {
    const auto allowed = [&](const TriedBias& t) {
        return (!row || t.row == row) && (!no_acne || t.trial.has_no_acne()) &&
               (!max_gap_m || t.trial.needs.gap_p95_m <= *max_gap_m);
    };
    const auto adds_none = [&](const TriedBias& t) {
        return allowed(t) && wrong_pixels(t.trial.error) <= wrong_pixels(before.error);
    };
    const bool some_adds_none = std::ranges::any_of(tried, adds_none);
    const auto may_win = [&](const TriedBias& t) { return some_adds_none ? adds_none(t) : allowed(t); };
    double score = std::numeric_limits<double>::infinity(), error = score, gap = score;
    for (const TriedBias& t : tried)
        if (may_win(t)) score = std::min(score, t.trial.score);
    const auto ties = [&](const TriedBias& t) { return may_win(t) && t.trial.score <= score * (1 + kScoreTie) + 0.5; };
    for (const TriedBias& t : tried)
        if (ties(t)) error = std::min(error, t.trial.error.mae);
    // The error decides only from half a pixel on, as the score does.
    const double half_pixel = before.error.counted > 0 ? 0.5 / double(before.error.counted) : 0;
    const auto both_tie = [&](const TriedBias& t) {
        return ties(t) && t.trial.error.mae <= error * (1 + kErrorTie) + half_pixel;
    };
    for (const TriedBias& t : tried)
        if (both_tie(t)) gap = std::min(gap, t.trial.needs.gap_p95_m);
    for (const TriedBias& t : tried)
        if (both_tie(t) && t.trial.needs.gap_p95_m <= gap * (1 + kGapTie)) return &t;
    return nullptr;
}

std::vector<const TriedBias*> FoundBias::best_of_rows(bool no_acne) const {
    std::vector<const TriedBias*> out;
    const Bias* row = nullptr;
    for (const TriedBias& t : tried)
        if (std::exchange(row, t.row) != t.row)
            if (const TriedBias* best = least_score(t.row, no_acne)) out.push_back(best);
    return out;
}

std::vector<FoundBiasRow> FoundBias::table() const {
    std::vector<FoundBiasRow> out;
    const TriedBias *const least = best(), *const clean = best_without_acne();
    for (const TriedBias* t : best_of_rows()) out.push_back({t, t == least, clean && clean->bias == t->bias});
    if (clean && std::ranges::none_of(out, &FoundBiasRow::clean)) out.push_back({clean, false, true});
    return out;
}

std::string FoundBias::summary(bool no_acne) const {
    if (before.needs.pixels == 0) return "nothing in the picture is lit within the map: no bias is needed";
    const TriedBias* found = no_acne ? best_without_acne() : best();
    const std::string within = max_gap_m ? fmt::format(" with a gap of at most {}", metres_text(*max_gap_m)) : "";
    if (found)
        return fmt::format("least bias{}{}: {}; {}{}", no_acne ? " without acne" : "", within, bias_text(found->bias),
                           trial_text(before, found->trial), stopped ? "; stopped before all rows were tried" : "");
    if (tried.empty()) return "no row of the bias table allows enough bias: a finer map or format is needed";
    const auto nearest = std::ranges::min_element(tried, {}, [](const TriedBias& t) { return t.trial.acne(); });
    if (no_acne && !nearest->trial.has_no_acne())
        return fmt::format("no bias is without acne: {} px remain under {}; a finer map or format is needed",
                           nearest->trial.acne(), bias_text(nearest->bias));
    return fmt::format("no bias{} was found; allow a wider gap", within);
}

FoundBias search_least_bias(const BiasTrial& before, const std::vector<BiasStart>& starts, const BiasMeter& meter,
                            std::optional<double> max_gap_m, const TrialReport& report, const FoundBiasShown& shown) {
    FoundBias out{.before = before, .tried = {}, .max_gap_m = max_gap_m};
    if (before.needs.pixels == 0) return out;  // without lit pixels there is no acne
    double all = 0, done = 0;
    const auto usual_trials = [](const BiasStart& s) {
        return s.has_strength() ? double(2 + std::size(kStronger) + std::size(kWeaker) + kFine + kBisections) : 1.0;
    };
    for (const BiasStart& s : starts) all += usual_trials(s);
    try {
        for (const BiasStart& s : starts) {
            int within = 0;
            const BiasMeter reporting = [&](const BiasSettings& bias) {
                if (report)
                    report((done + std::min(double(within++), usual_trials(s))) / all,
                           fmt::format("{}: {}", s.row->label, bias_text(bias)));
                return meter(bias);
            };
            StrengthSearch(s, reporting, out).run();
            done += usual_trials(s);
            if (shown) shown(out);
        }
    } catch (const Cancelled&) {
        if (out.tried.empty()) throw;
        out.stopped = true;
    }
    return out;
}

FoundBias find_least_bias(const SearchTools& whole, const Settings& settings, std::optional<double> max_gap_m,
                          const FoundBiasShown& shown) {
    const SearchTools tools = whole.part();
    const Settings base = measured_settings(settings);
    const TrialMeter meter = renderer_trial_meter(tools, {.work = false});
    const RasterTraits& driver = tools.renderer.driver();
    if (const std::string why = reason_without_bias(fit_lights(tools.scene, base), base.view.light); !why.empty())
        throw Error(why);
    tools.report(0, "the present bias");
    const MeasuredError first = *meter.measure(base, base.view.light).frame;
    const BiasScore score(first, base);
    const auto trial = [&](const MeasuredError& m, const Settings& s) {
        return BiasTrial{m.metrics, bias_needs(m, s, driver), score.compute_score(m)};
    };
    const auto light = std::size_t(std::max(base.view.light, 0));
    const MapFacts facts =
        map_facts(light < first.lights.size() ? &first.lights[light] : nullptr, base, first.map_size);
    const auto completed = [&](const BiasSettings& bias) {
        return tools.engine ? with_hidden_bias(*tools.engine, bias, facts) : bias;
    };
    // Several rows draw the same picture where their amounts are 0.
    std::vector<std::pair<Settings, BiasTrial>> measured;
    const BiasMeter measure = [&](const BiasSettings& bias) {
        Settings s = base;
        s.bias = completed(bias);
        const Settings effective = without_ineffective_settings(s);
        const auto known = std::ranges::find(measured, effective, &std::pair<Settings, BiasTrial>::first);
        if (known != measured.end()) return known->second;
        measured.emplace_back(effective, trial(*meter.measure(s, s.view.light).frame, s));
        return measured.back().second;
    };
    std::vector<BiasStart> starts = bias_starts(first, base, driver);
    std::erase_if(starts, [&](const BiasStart& s) { return tools.engine && !has_bias_row(*tools.engine, s.row->key); });
    FoundBias found = search_least_bias(trial(first, base), starts, measure, max_gap_m, tools.report, shown);
    for (TriedBias& tried : found.tried) tried.bias = completed(tried.bias);
    return found;
}

std::string reason_without_bias(std::span<const FittedLight> lights, int light) {
    const auto i = std::size_t(std::max(light, 0));
    if (i >= lights.size()) return fmt::format("there is no light {}: there is no bias to find", i);
    if (lights[i].casts) return {};
    return fmt::format("light {} draws no shadow map ({}): there is no bias to find", i, lights[i].reason);
}

std::string bias_text(const BiasSettings& b) {
    Settings s;
    s.bias = b;
    const Bias& row = bias_of(s);
    std::string text(row.gives_needed_bias ? row.key : "");
    const auto add = [&](const char* key, double value, const char* of) {
        if (value != 0) text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", key, digits_text(value), of);
    };
    const char* const unit = b.unit == BiasUnit::Texels ? " texels" : b.unit == BiasUnit::Metres ? " m" : "";
    if (reads_setting(row, "bias.constant")) add("bias.constant", b.constant, unit);
    if (reads_setting(row, "bias.slope")) add("bias.slope", b.slope, unit);
    add("bias.normal", b.normal, b.normal_unit == OffsetUnit::Texels ? " texels" : " m");
    if (b.normal != 0 && b.normal_by != OffsetBy::Length)
        text += fmt::format(" ({})", value_text(*find_setting("bias.normal_by")->param, int(b.normal_by)));
    add("bias.raster_slope", b.raster_slope, "");
    add("bias.raster_units", b.raster_units, "");
    return text.empty() ? "no bias" : text;
}

}  // namespace si
