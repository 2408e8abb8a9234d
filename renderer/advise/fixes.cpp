#include "renderer/advise/fixes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "renderer/base/lengths_text.h"
#include "renderer/inspect/given_map_changes.h"
#include "renderer/measure/axes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

/// Returns the map resolution at which 95 % of the undersampled pixels have narrow enough texels.
double sampling_resolution(const MeasuredError& m, const Settings& settings, const DriverInfo& driver) {
    const FittedLight& light = m.lights[std::size_t(m.light)];
    const MeasuredBias bias(m, settings, driver);
    const double kappa = std::max(kernel_reach_in_light(settings, light, m.map_size).bias, 0.5);
    std::vector<double> wanted;
    for (std::size_t i = 0; i < m.classified.size(); ++i) {
        if (m.classified[i].artefact != Artefact::Undersampled) continue;
        const Receiver& r = m.traced.receivers->pixels[i];
        const BiasBreakdown a = bias.breakdown(r);
        const float run_m = m.traced.runs->run_m.data[i];
        double n = run_m > 0 && a.receiver.texel_m > run_m ? m.map_resolution * a.receiver.texel_m / run_m : 0;
        // Finer texels make room for a right bias where even one nearest tap has none.
        const double gap_m = m.traced.reference->blocker_m.data[i];
        if (std::isfinite(gap_m)) {
            const double along = gap_m * glm::dot(a.receiver.to_light, light.views[a.receiver.view].axes[2]);
            const double fixed = a.least.quantum + a.least.rounding,
                         falls = a.least.kernel * 0.5 / kappa + a.least.snapping;
            const double room = a.curve.depth_change_towards_light(a.receiver.own_m, along) - fixed;
            if (room > 0) n = std::max(n, m.map_resolution * falls / room);
        }
        wanted.push_back(n);
    }
    if (wanted.empty()) return 0;
    const auto at = wanted.begin() + std::ptrdiff_t(0.95 * double(wanted.size() - 1) + 0.5);
    std::nth_element(wanted.begin(), at, wanted.end());
    return std::exp2(std::ceil(std::log2(std::max(*at, 1.0)) - 1e-9));  // a power of two
}

/// Converts a label for use in a sentence: "Receiver plane" becomes "receiver plane".
std::string in_a_sentence(std::string_view label) {
    std::string out(label);
    if (!out.empty()) out[0] = char(std::tolower(static_cast<unsigned char>(out[0])));
    return out;
}

/// Proposes other fits of a light's map, and other numbers of cascades.
template <class Idea>
void add_fits(const Settings& base, const FixFacts& f, Idea idea) {
    const auto light = std::size_t(f.light);
    const FittedLight& fitted = f.lights[light];
    const bool sun = fitted.type == LightType::Directional;
    const bool by_hand = base.lights[light].fit == LightFit::Manual;
    // Fits apply to maps whose rays are the light's own.
    const bool narrows = fitted.views.size() == 1 && sun != fitted.is_perspective();
    for (std::size_t i = 0; i < fits().size(); ++i) {
        const FitRow& row = fits()[i];
        const auto fit = static_cast<LightFit>(i);
        if (fit == LightFit::Manual || fit == base.lights[light].fit) continue;
        if (row.narrows ? !narrows : !narrows && !by_hand) continue;
        idea(fmt::format("fit: {}", row.label), [&](Settings& s) { s.lights[light].fit = fit; });
    }
    if (!narrows && fitted.views.size() == 1)
        idea(
            "tighter fit", [](Settings&) {}, "only a map whose rays are the light's own can be fitted tighter");
    if (fitted.chooser.choice == ViewChoice::Face)
        idea(
            "tighter fit", [](Settings&) {}, "six faces hold all directions");
    if (!sun || by_hand || fitted.is_perspective()) return;
    for (int n = 1; n <= kMaxCascades; n *= 2)
        idea(fmt::format("{} cascades", n), [&](Settings& s) { s.lights[light].cascades = n; });
}

/// Settings whose value alone may put pixels right, for maps of any kind. LIGHT stands for the light's prefix.
struct SingleChange {
    std::string_view key, value;
    bool moments = false;  ///< for kernels by moments only
};
constexpr SingleChange kSingleChanges[] = {
    {"caster.cull", "none"},
    {"caster.cull", "back"},
    {"caster.cull", "front"},
    {"LIGHT.near_far", "fitted"},
    {"LIGHT.near_far", "pancaking"},
    {"LIGHT.near", "0"},
    {"LIGHT.contact", "0"},
    {"LIGHT.size", "0"},
    {"LIGHT.projection", "auto"},
    {"LIGHT.cascade_blend", "0"},
    {"LIGHT.cascade_choice", "interval"},
    {"bias.normal", "0"},
    {"bias.normal_source", "geometric"},
    {"map.format", "d32f"},
    {"map.origin", "near"},
    {"map.reversed_z", "false"},
    {"map.outside", "lit"},
    {"map.outside", "unlit"},
    {"map.far_guard", "true"},
    {"map.wrap", "border"},
    {"map.compare", "lequal"},
    {"map.compare", "less"},
    {"map.blur_texels", "0"},
    {"map.virtual", "false"},
    {"caster.blend", "mask"},
    {"filter.radius_unit", "texels"},
    {"filter.blur", "0", true},
    {"filter.blur", "1", true},
    {"filter.bleed", "0", true},
    {"filter.bleed", "0.5", true},
    {"filter.bleed", "0.8", true},
    {"filter.min_variance", "1e-09", true},
    {"filter.min_variance", "1e-07", true},
    {"filter.min_variance", "1e-05", true},
    {"filter.moment_format", "32-bit", true},
    {"filter.moment_bias", "3e-06", true},
    {"filter.exponent", "20", true},
    {"filter.exponent", "40", true},
    {"filter.exponent", "80", true},
    {"filter.negative_exponent", "5", true},
    {"filter.negative_exponent", "20", true},
    {"filter.mips", "false", true},
};
constexpr double kShortStrengths[] = {1, 0.25};
constexpr double kWholeStrengths[] = {1, 0.5, 0.25, 0.125, 0.0625, 2};

/// Collects candidates without those that change nothing, repeat another one, or set a value at its limit.
class CandidateList {
public:
    explicit CandidateList(const Settings& base, int light)
        : base_(base), light_(light), known_{without_ineffective_settings(base)} {}

    void add(std::string name, const Settings& s, std::string untried = {}) {
        if (untried.empty() && is_known(s)) return;
        if (untried.empty() && at_limit(s)) untried = "a setting would be at its limit";
        list.push_back({.name = std::move(name), .settings = s, .untried = std::move(untried), .light = light_});
    }
    std::vector<Candidate> list;

private:
    const Settings& base_;
    int light_;
    std::vector<Settings> known_;

    bool is_known(const Settings& s) {
        Settings effective = without_ineffective_settings(s);
        if (std::ranges::find(known_, effective) != known_.end()) return true;
        known_.push_back(std::move(effective));
        return false;
    }
    /// Returns true when an amount of bias is at the largest value that the settings allow.
    bool at_limit(const Settings& s) const {
        return std::ranges::any_of(differing_settings(base_, s), [&](const SettingRef& ref) {
            const Value value = get_value(s, ref);
            return ref.param->key.starts_with("bias.") && std::holds_alternative<double>(value) &&
                   std::get<double>(value) >= ref.param->max;
        });
    }
};

/// Reason why a trial is not called a fix although nothing but its time is unknown.
constexpr const char* kNotTimed = "not timed: only the best fix is";
constexpr double kMostBytes = 2;       ///< bytes of a fix's maps, as a multiple of the present ones
constexpr double kMostDrawnBytes = 4;  ///< the same of maps that are drawn to see what they would put right
/// Share of the wrong pixels that a fix puts right, from which on larger maps are not tried.
constexpr double kEnoughRight = 0.8;

/// Returns true for a trial that is a fix but for its time, which may be unknown.
bool may_be_fix(const Trial& t) {
    return t.is_drawn() && (t.why_not.empty() || t.why_not == kNotTimed);
}

/// Returns true for maps of more than `most` times the present bytes; false if there are no maps now.
bool takes_too_many_bytes(std::uint64_t before, std::uint64_t with, double most = kMostBytes) {
    return before > 0 && double(with) > most * double(before);
}

/// Returns true when an amount rises by more than a tolerance.
bool rises(double was, double is, double tolerance) {
    return is > was + tolerance + 1e-12;
}

/// Returns the reason why a change is no fix by what is known without causes: the watched pixel, the wrong pixels and
/// the mean error. Empty: it may be one.
/// @param noise noise of the reference's pixels; NaN: unknown
std::string why_no_better(const ErrorMetrics& before, const ErrorMetrics& with, const std::optional<PixelTrial>& pixel,
                          double noise) {
    if (pixel && (!pixel->right || std::abs(pixel->visibility - pixel->reference) > kRightVisibilityError))
        return fmt::format("this pixel stays wrong: visibility {:.2f} instead of {:.2f}", pixel->visibility,
                           pixel->reference);
    const double n = std::max<double>(double(before.counted), 1);
    const double noise_px = before.within_noise * n;  // 0 for a light without size
    const double mean_noise = std::isfinite(noise) ? noise / std::sqrt(n) : 0;
    const std::size_t wrong = wrong_pixels(before), now = wrong_pixels(with);
    if (rises(double(wrong), double(now), std::sqrt(noise_px)))
        return fmt::format("wrong pixels rise from {} to {}", wrong, now);
    if (rises(before.mae, with.mae, mean_noise))
        return fmt::format("the mean error rises from {:.4g} to {:.4g}", before.mae, with.mae);
    return pixel || with.mae < before.mae - mean_noise ? "" : "the mean error does not fall";
}

/// Returns the reason why a drawn trial is no fix, all but its time considered; empty: it may be one.
std::string why_no_fix(const Trial& t, const ErrorMetrics& before) {
    if (std::string why = why_no_better(before, t.metrics, t.pixel, t.before.noise); !why.empty()) return why;
    if (takes_too_many_bytes(t.before.work.map_bytes, t.after.work.map_bytes))
        return fmt::format("maps take more than twice the bytes ({})", map_bytes_text(t.map_bytes()));
    const auto pixels = [&](double share) { return std::llround(share * std::max<double>(double(before.counted), 1)); };
    if (rises(before.any_acne, t.metrics.any_acne, 0))
        return fmt::format("pixels with any acne rise from {} to {}", pixels(before.any_acne),
                           pixels(t.metrics.any_acne));
    if (rises(before.any_leak, t.metrics.any_leak, 0))
        return fmt::format("pixels with any leak rise from {} to {}", pixels(before.any_leak),
                           pixels(t.metrics.any_leak));
    const auto same_source = [&](const auto& change) { return !change.first.ends_with(".source"); };
    if (!std::ranges::all_of(t.changes, same_source)) return "light.source would change";
    return {};
}

/// Search of find_fixes().
class FixSearcher {
public:
    /// @param times_first times the first fix at once, for a table that is shown before the search ends
    FixSearcher(const Settings& base, const TrialMeter& meter, const FixOptions& options, bool times_first)
        : base_(base), meter_(meter), options_(options), times_first_(times_first) {}

    /// Rates a trial and keeps it. Times the first fix in few rounds if the table is shown.
    /// @param own own maps on which the trial was drawn; null: it was not
    void add(Trial t, const ErrorMetrics& before, const OwnMap* own = nullptr) {
        if (t.is_drawn()) {
            t.why_not = why_no_fix(t, before);
            // The whole change has to be a fix, and so has the step on own maps.
            if (own && t.why_not.empty()) t.why_not = why_no_fix(t, own->before.frame->metrics);
            if (own) own_ = &own->settings;
            if (options_.time) {
                limit_time(t, Rounds::All);
            } else if (times_first_ && t.why_not.empty() && !table.fix()) {
                limit_time(t, Rounds::Few);
                in_few_rounds_ = t.candidate.settings;
            }
            if (t.why_not.empty() && !t.ms) t.why_not = kNotTimed;
        }
        insert(std::move(t));
    }
    /// Returns the bytes of the maps that a change would draw. 0: unknown.
    std::uint64_t map_bytes(const Candidate& c) const {
        // Imported maps stay as they are: try_candidate() refuses changes that need others.
        const bool drawn = meter_.map_bytes && c.untried.empty() && c.settings.map.bundle.empty();
        return drawn ? meter_.map_bytes(c.settings) : 0;
    }
    /// Returns the reason why a change whose maps are too large for a fix is not drawn: they are far too large, or a
    /// fix with smaller ones puts most wrong pixels right. Empty: it is drawn.
    /// @param bytes, with bytes of the present maps, and of the change's
    std::string why_too_large(std::uint64_t bytes, std::uint64_t with) const {
        const std::string more = map_bytes_text((long long)with - (long long)bytes);
        if (takes_too_many_bytes(bytes, with, kMostDrawnBytes))
            return fmt::format("maps would take more than {:g} times the bytes ({})", kMostDrawnBytes, more);
        double most_right = 0;
        for (const Trial& t : table.rows)
            if (may_be_fix(t))
                most_right = std::max(most_right, double(t.cured) / double(std::max<std::size_t>(table.wrong, 1)));
        if (most_right < kEnoughRight) return {};
        return fmt::format(
            "maps would take more than twice the bytes ({}); a fix with smaller ones puts {:.0f} % of the wrong pixels "
            "right",
            more, 100 * most_right);
    }
    /// Times trials that leave less error than the fix, the best first, until one of them is the fix. The fix is timed
    /// in all rounds. @throws Cancelled; the table then has all its rows
    void time_better_ones() {
        for (auto at = next_to_time(); at != table.rows.end(); at = next_to_time()) {
            Trial t = *at;
            t.why_not.clear();
            limit_time(t, Rounds::All);
            if (t.candidate.settings == in_few_rounds_) in_few_rounds_.reset();
            table.rows.erase(at);
            insert(std::move(t));
        }
    }
    FixTable table;

private:
    const Settings& base_;
    const TrialMeter& meter_;
    const FixOptions& options_;
    const bool times_first_;
    const Settings* own_ = nullptr;                  ///< settings of the own maps, once known
    std::optional<Settings> in_few_rounds_;          ///< settings of the first fix until it is timed in all rounds
    std::optional<CostChange> shadow_, own_shadow_;  ///< time of the shadow, once measured; on own maps

    void insert(Trial t) {
        const auto at = std::ranges::find_if(table.rows, [&](const Trial& other) { return is_better(t, other); });
        table.rows.insert(at, std::move(t));
    }

    /// Returns the trial to time next: the best untimed one if it leaves less error than the fix, else the fix if it
    /// was timed in few rounds. The end of the rows: none.
    std::vector<Trial>::iterator next_to_time() {
        const auto is_untimed = [](const Trial& t) { return t.is_drawn() && t.why_not == kNotTimed; };
        // The rows of one rank are sorted.
        const auto at = std::ranges::find_if(table.rows, is_untimed);
        if (at != table.rows.end()) {
            Trial best = *at;
            best.why_not.clear();
            if (!table.fix() || is_better(best, *table.fix())) return at;
        }
        const bool is_open = table.fix() && table.fix()->candidate.settings == in_few_rounds_;
        return is_open ? table.rows.begin() : table.rows.end();
    }

    /// Rounds of frames that time a trial.
    enum class Rounds { Few, All };

    /// Times a trial. A change that costs more than the shadow does is no fix.
    void limit_time(Trial& t, Rounds rounds) {
        const Settings& base = t.on_own_map ? *own_ : base_;
        t.ms = rounds == Rounds::Few ? meter_.time_in_few_rounds(base, t.candidate.settings)
                                     : meter_.time(base, t.candidate.settings);
        // The shadow itself is timed only for a change that costs time.
        if (!t.why_not.empty() || !(t.ms->value > t.ms->noise)) return;
        std::optional<CostChange>& shadow = t.on_own_map ? own_shadow_ : shadow_;
        if (!shadow) {
            Settings unshadowed = base;
            unshadowed.lights[std::size_t(t.candidate.light)].cast = false;
            shadow = meter_.time(unshadowed, base);
        }
        const double limit = std::max(shadow->value, 0.0) + shadow->noise;
        if (t.ms->value > limit + t.ms->noise)
            t.why_not = fmt::format("the shadow takes {} ms, and {} ms more with it", digits_text(shadow->value),
                                    digits_text(t.ms->value));
    }

    static bool is_better(const Trial& a, const Trial& b) {
        const auto rank = [](const Trial& t) {
            const int kind = !t.is_drawn() ? 3 : t.why_not.empty() ? 0 : t.pixel && !t.pixel->right ? 2 : 1;
            return std::tuple(kind, kind == 0 && t.on_own_map, t.metrics.mae, wrong_pixels(t.metrics),
                              t.ms ? t.ms->value : 0, t.map_bytes());
        };
        return rank(a) < rank(b);
    }
};

}  // namespace

std::pair<std::string_view, std::string_view> adjacent_kernels(const Settings& settings) {
    const auto edge = [](const Settings& s) {
        const Filter& row = filter_of(s);
        return row.reach(row, s, 0).edge;
    };
    const double reach = edge(settings);
    std::pair<std::string_view, std::string_view> out;
    double narrower = 0, wider = std::numeric_limits<double>::infinity();
    for (const std::string_view kernel : sweep_kernels()) {
        Settings s = settings;
        set_setting(s, "filter.kernel", kernel);
        if (!filter_of(s).square()) continue;
        const double other = edge(s);
        if (other < reach && other > narrower) {
            narrower = other;
            out.first = kernel;
        }
        if (other > reach && other < wider) {
            wider = other;
            out.second = kernel;
        }
    }
    return out;
}

FixFacts fix_facts(const MeasuredError& measured, const Settings& settings, const DriverInfo& driver) {
    FixFacts f;
    f.starts = bias_starts(measured, settings, driver);
    f.lights = measured.lights;
    f.light = measured.light;
    f.map_resolution = measured.map_resolution;
    f.max_resolution = driver.max_texture_size;
    f.sampling_resolution = sampling_resolution(measured, settings, driver);
    return f;
}

std::vector<Candidate> fix_candidates(const Settings& base, const FixFacts& f, FixList length) {
    CandidateList out(base, f.light);
    const auto idea = [&](std::string name, auto&& change, std::string untried = {}) {
        Settings s = base;
        change(s);
        out.add(std::move(name), s, std::move(untried));
    };
    if (!source_of(base, f.light).needs.map) {
        idea("a shadow map", [&](Settings& s) { s.lights[std::size_t(f.light)].source = LightSettings{}.source; });
        return out.list;
    }
    // Rows of the bias table that compute the needed bias by themselves go with every other change.
    std::vector<std::pair<std::string, BiasSettings>> automatic;
    for (const BiasStart& start : f.starts) {
        if (!start.row->gives_needed_bias) continue;
        automatic.emplace_back(in_a_sentence(start.row->label), start.at_strength(0));
        idea("least bias, " + automatic.back().first, [&](Settings& s) { s.bias = automatic.back().second; });
    }
    const auto combined = std::span(automatic).last(
        length == FixList::Whole ? automatic.size() : std::min<std::size_t>(automatic.size(), 1));
    const auto with_biases = [&](const std::string& name, auto&& change) {
        idea(name, change);
        for (const auto& own : combined)
            idea(fmt::format("{}, least bias, {}", name, own.first), [&](Settings& s) {
                change(s);
                s.bias = own.second;
            });
    };
    const auto strengths = [&](std::span<const double> list) {
        for (const BiasStart& start : f.starts) {
            if (!start.has_strength()) continue;
            for (const double strength : list)
                idea(strength == 1 && !start.row->gives_needed_bias
                         ? "least bias, " + in_a_sentence(start.row->label)
                         : fmt::format("{:g} of the least bias, {}", strength, in_a_sentence(start.row->label)),
                     [&](Settings& s) { s.bias = start.at_strength(strength); });
        }
    };
    strengths(kShortStrengths);
    idea("no polygon offset", [](Settings& s) { s.bias.raster_slope = s.bias.raster_units = 0; });
    with_biases("no culling by objects", [](Settings& s) {
        for (auto& [path, object] : s.objects) object.cull = ObjectCull::Inherit;
    });
    with_biases("both sides cast", [](Settings& s) {
        s.caster.cull = Cull::None;
        for (auto& [path, object] : s.objects) object.cull = ObjectCull::Inherit;
    });
    const bool moments = filter_of(base).samples() == Samples::Moments;
    for (const SingleChange& c : kSingleChanges) {
        if (c.moments && !moments) continue;
        std::string key(c.key);
        if (key.starts_with("LIGHT")) key = fmt::format("light.{}{}", f.light, key.substr(5));
        with_biases(fmt::format("{}={}", key, c.value), [&](Settings& s) { set_setting(s, key, c.value); });
    }
    const auto kernel = [](std::string_view text) {
        return [=](Settings& s) { set_setting(s, "filter.kernel", text); };
    };
    const auto [down, up] = adjacent_kernels(base);
    if (!down.empty()) with_biases("narrower kernel", kernel(down));
    if (!up.empty()) with_biases("wider kernel", kernel(up));
    // Another kernel by moments may not bleed. Of all other kernels the short list has the narrowest.
    for (const std::string_view k : sweep_kernels()) {
        Settings with = base;
        set_setting(with, "filter.kernel", k);
        const bool other_moments = moments && filter_of(with).samples() == Samples::Moments;
        if (length == FixList::Whole || other_moments || k == sweep_kernels().front())
            with_biases(fmt::format("kernel: {}", k), kernel(k));
    }

    const auto resolution = [&](double n, const std::string& name) {
        const std::string title = fmt::format("{} ({:.0f}²)", name, n);
        const double most = std::min(double(f.max_resolution), find_setting("map.resolution")->param->max);
        if (n > most)
            idea(
                title, [](Settings&) {}, fmt::format("above the limit of {:.0f}²", most));
        else
            with_biases(title, [&](Settings& s) { s.map.resolution = int(n); });
    };
    resolution(2.0 * f.map_resolution, "twice the resolution");
    if (f.sampling_resolution > 2.0 * f.map_resolution)
        resolution(f.sampling_resolution, "the resolution that is needed");
    if (length == FixList::Whole) resolution(0.5 * f.map_resolution, "half the resolution");
    add_fits(base, f, [&](const std::string& name, auto&& change, const std::string& untried = {}) {
        if (untried.empty())
            with_biases(name, change);
        else
            idea(name, change, untried);
    });
    if (length == FixList::Whole) strengths(kWholeStrengths);
    return out.list;
}

Candidate suggested_candidate(const SuggestedFix& fix, const Settings& settings) {
    Candidate c{.name = fix.text, .settings = settings, .label = fix_text(fix, settings) + equivalent_bias_text(fix)};
    set_settings(c.settings, fix.settings);
    return c;
}

const Trial* FixTable::fix() const {
    return rows.empty() || !rows.front().is_drawn() || !rows.front().why_not.empty() ? nullptr : &rows.front();
}

const Trial* FixTable::untimed_fix() const {
    const auto at = std::ranges::find_if(rows, [](const Trial& t) { return may_be_fix(t) && !t.why_not.empty(); });
    return at == rows.end() ? nullptr : &*at;
}

const Trial* FixTable::fix_of(Artefact cause) const {
    const Trial* best = nullptr;
    const auto of = [&](const Trial& t) { return t.cured_of[std::size_t(cause)]; };
    for (const Trial& t : rows)
        if (may_be_fix(t) && of(t) > 0 && (!best || of(t) > of(*best))) best = &t;
    return best;
}

std::size_t FixTable::drawn() const {
    return std::size_t(std::ranges::count_if(rows, &Trial::is_drawn));
}

FixTable search_fixes(const Settings& base, const MeasuredSettings& before, std::vector<Candidate> list,
                      const TrialMeter& meter, const FixOptions& options, const TrialReport& report,
                      const std::function<void(const FixTable&)>& shown, std::size_t enough,
                      const std::function<OwnMap()>& own) {
    FixSearcher search(base, meter, options, bool(shown));
    FixTable& table = search.table;
    const ErrorMetrics& error = before.frame->metrics;
    std::ranges::copy(error.artefacts, table.wrong_of.begin());
    table.wrong_of[std::size_t(Artefact::None)] = 0;
    table.wrong = wrong_pixels(error);
    table.candidates = list.size();
    std::optional<std::size_t> pixel;
    if (options.pixel) {
        pixel = std::size_t(options.pixel->y) * std::size_t(before.frame->traced.reference->width) +
                std::size_t(options.pixel->x);
    }
    bool too_large = false;  // the present trial's maps are too large for a fix
    const NeedsCauses needs_causes = [&](const MeasuredError& compared) {
        if (too_large) return false;
        const std::optional<PixelTrial> watched = pixel ? std::optional(pixel_trial(compared, *pixel)) : std::nullopt;
        return why_no_better(error, compared.metrics, watched, before.noise).empty();
    };
    std::optional<OwnMap> own_map;
    std::size_t tried = 0;
    table.stopped = !try_each(std::move(list), report, [&](Candidate& c) {
        const std::uint64_t bytes = search.map_bytes(c);
        too_large = takes_too_many_bytes(before.work.map_bytes, bytes);
        if (too_large) c.untried = search.why_too_large(before.work.map_bytes, bytes);
        Trial t = try_candidate(base, before, c, meter, pixel, needs_causes);
        if (own && t.candidate.untried == kNeedsAnotherMap) {
            if (!own_map) own_map = own();
            t = try_on_own_map(base, before, *own_map, std::move(c), meter, pixel, needs_causes);
        }
        const OwnMap* const drawn_on = t.on_own_map ? &*own_map : nullptr;
        search.add(std::move(t), error, drawn_on);
        if (shown) shown(table);
        if (++tried < enough) return true;
        search.time_better_ones();
        return !table.fix();
    });
    try {
        if (!table.stopped) search.time_better_ones();
        if (shown) shown(table);
    } catch (const Cancelled&) {
        table.stopped = true;
    }
    return table;
}

FixTable find_fixes(const SearchTools& whole, const Settings& settings, const FixOptions& options,
                    const std::function<void(const FixTable&)>& shown) {
    const SearchTools tools = whole.part();
    const Settings base = measured_settings(settings);
    const ReferenceOptions reference = options.pixel ? ReferenceOptions() : reference_options(settings);
    const TrialMeter meter = renderer_trial_meter(tools, {.work = false, .reference = reference});
    tools.report(0, "the present settings");
    const MeasuredSettings before = meter.measure(base, base.view.light);
    const ErrorMetrics& error = before.frame->metrics;
    if (wrong_pixels(error) == 0 && !(error.any_acne + error.any_leak > 0)) return {};
    const FixFacts facts = fix_facts(*before.frame, base, tools.renderer.driver());
    std::vector<Candidate> list = fix_candidates(base, facts, options.first ? FixList::Short : options.list);
    const auto add = [&](Candidate more) {
        more.settings = measured_settings(more.settings);
        more.light = base.view.light;
        const auto same = [&](const Candidate& c) { return c.name == more.name || c.settings == more.settings; };
        if (!(more.settings == base) && std::ranges::none_of(list, same)) list.push_back(std::move(more));
    };
    for (const Candidate& more : options.more) add(more);
    const std::size_t enough = options.first ? list.size() : std::numeric_limits<std::size_t>::max();
    if (options.first && options.list == FixList::Whole)
        for (Candidate& more : fix_candidates(base, facts, FixList::Whole)) add(std::move(more));
    std::function<OwnMap()> own;
    if (!base.map.bundle.empty()) own = [&] { return own_map_of(tools, base, before, meter); };
    const std::size_t refused = remove_refused(list, tools.engine, base);
    const auto with_refused = [&](FixTable table) {
        table.refused = refused;
        return table;
    };
    // Empty if nobody sees the table: the search then times no fix before its end.
    std::function<void(const FixTable&)> show;
    if (shown) show = [&](const FixTable& table) { shown(with_refused(table)); };
    return with_refused(search_fixes(base, before, std::move(list), meter, options, tools.report, show, enough, own));
}

}  // namespace si
