#include "renderer/advise/autopilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "renderer/base/lengths_text.h"
#include "renderer/inspect/given_map_changes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "renderer/settings/starting_values.h"

namespace si {
namespace {

using AxisChoice = std::vector<std::size_t>;

constexpr double kMaxTieShare = 0.1;  ///< cases within this share of the least time are timed against each other
constexpr std::size_t kFinalists = 3;
constexpr int kMaxTimings = 3;
// Shares of the search time: measuring errors ends after the first; the second is kept for timing dropped settings.
constexpr double kMeasuringShare = 0.6, kTimingShare = 0.15;

std::string value_of(const Settings& s, const std::string& key) {
    const SettingRef ref = *find_setting(key);
    return value_text(*ref.param, get_value(s, ref));
}

class AutopilotSearch {
public:
    AutopilotSearch(const Settings& start, const std::vector<SweepAxis>& axes, const AutopilotGoals& goals,
                    const TrialMeter& meter, const TrialReport& report, const AutopilotShow& show)
        : start_(start),
          axes_(axes),
          goals_(goals),
          meter_(meter),
          report_(report),
          show_(show),
          begun_s_(meter.now_s()) {}

    AutopilotResult run() {
        AutopilotResult out;
        out.before = meter_.measure(start_, start_.view.light);
        leave_out_axes_of_imported_maps(out);
        out.before.frame.reset();
        const CostChange before_ms = meter_.ms(start_);
        out.before_ms = before_ms.value;
        before_ = out.before;
        before_ms_ = out.before_ms;
        for (const SweepAxis& axis : axes_) combinations_ *= axis.values.size();
        out.combinations = combinations_;
        at_.assign(axes_.size(), 0);
        if (settings_at(at_) == start_)
            known_[at_] = {.axis_values = at_,
                           .settings = start_,
                           .changes = {},
                           .classified = out.before,
                           .ms = out.before_ms,
                           .ms_noise = before_ms.noise};
        if (known_.contains(at_)) decide(known_.at(at_));
        const bool all = out.combinations <= goals_.max_combinations;
        try {
            if (all)
                search_block(all_axes());
            else
                search_by_parts();
        } catch (const Cancelled&) {
            out.stopped = true;
            out.untried.push_back("stopped before all combinations were tried");
        }
        if (!all) {
            out.untried.push_back(
                fmt::format("{} of {} combinations were not tried: two settings were searched at a time",
                            out.combinations - known_.size(), out.combinations));
        }
        finish(out);
        return out;
    }

private:
    const Settings& start_;
    std::vector<SweepAxis> axes_;
    const AutopilotGoals& goals_;
    const TrialMeter& meter_;
    const TrialReport& report_;
    const AutopilotShow& show_;
    double begun_s_;
    MeasuredSettings before_;
    double before_ms_ = 0;
    std::map<AxisChoice, AutopilotCase> known_;
    AxisChoice at_;
    std::set<AxisChoice> unmeasured_;
    std::size_t untimed_ = 0;
    std::size_t combinations_ = 1;

    /// Removes the axes whose settings act only while maps are drawn, if the maps are imported.
    /// @param out has the measurement of the present settings, and receives a sentence on each removed axis
    void leave_out_axes_of_imported_maps(AutopilotResult& out) {
        std::erase_if(axes_, [&](const SweepAxis& axis) {
            const SettingRef ref = *find_setting(axis.key);
            const int light = ref.param->scope == Scope::Light ? ref.light : start_.view.light;
            if (!acts_while_drawing(axis.key) || !has_imported_maps(out.before, light)) return false;
            out.untried.push_back(fmt::format("{} was not varied: it {}", axis.key, kNeedsAnotherMap));
            return true;
        });
    }

    double spent_s() const { return meter_.now_s() - begun_s_; }
    bool late() const { return spent_s() > goals_.max_seconds; }
    /// Returns true when the remaining time is kept for measuring dropped settings.
    bool late_to_search() const { return spent_s() > (1 - kTimingShare) * goals_.max_seconds; }
    /// Returns true when the remaining time is kept for timing measured cases.
    bool out_of_measuring_time() const { return spent_s() > kMeasuringShare * goals_.max_seconds; }
    void report_progress(const std::string& what) const {
        const double cases = double(known_.size()) / double(std::max<std::size_t>(combinations_, 1));
        if (report_) report_(std::min(std::max(spent_s() / goals_.max_seconds, cases), 0.99), what);
    }

    Settings settings_at(const AxisChoice& at) const {
        Settings s = start_;
        bool bias = false;
        std::set<std::string> held;
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            held.insert(axes_[i].held.begin(), axes_[i].held.end());
            const std::string& value = axes_[i].values[at[i]];
            if (value.empty()) continue;
            set_setting(s, axes_[i].key, value);
            held.insert(axes_[i].key);
            bias |= axes_[i].key.starts_with("bias.");
        }
        set_starting_values(start_, s, held);
        // Wider kernels need more bias.
        if (!bias && !(s.filter == start_.filter))
            s.bias = scale_bias(s.bias, std::max(reach_of(s).bias, 0.5) / std::max(reach_of(start_).bias, 0.5));
        return s;
    }

    std::string name_of(const AxisChoice& at) const {
        std::string text;
        for (std::size_t i = 0; i < axes_.size(); ++i)
            if (!axes_[i].values[at[i]].empty())
                text += fmt::format("{}{}={}", text.empty() ? "" : " ", axes_[i].key, axes_[i].values[at[i]]);
        return text.empty() ? "the present settings" : text;
    }

    AutopilotCase* classified(const AxisChoice& at) {
        if (const auto it = known_.find(at); it != known_.end()) return &it->second;
        if (out_of_measuring_time()) return nullptr;
        report_progress(name_of(at));
        AutopilotCase c{.axis_values = at, .settings = settings_at(at), .changes = {}, .classified = {}, .ms = {}};
        c.changes = setting_changes(start_, c.settings);
        c.classified = meter_.measure(c.settings, start_.view.light);
        c.classified.frame.reset();
        decide(c);
        AutopilotCase& added = known_.emplace(at, std::move(c)).first->second;
        show_so_far();
        return &added;
    }

    /// Shows all cases so far, with the best of them.
    void show_so_far() {
        if (!show_) return;
        AutopilotResult out;
        out.before = before_;
        out.before_ms = before_ms_;
        out.combinations = combinations_;
        out.seconds = spent_s();
        const AutopilotCase* best = nullptr;
        for (const auto& [at, c] : known_) {
            out.cases.push_back(c);
            if (c.holds.value_or(false) && (!best || cost_of_case(c) < cost_of_case(*best))) best = &c;
        }
        out.goals_met = best != nullptr;
        if (best) out.best = *best;
        out.summary = fmt::format("{} of {} combinations measured", known_.size(), combinations_);
        show_(out);
    }

    bool accurate(const AutopilotCase& c) const { return !goals_.max_error || c.classified.error <= *goals_.max_error; }
    /// Returns true when a case is within both limits; times it if needed. False when there is no time left.
    bool time_it(AutopilotCase& c) {
        if (!c.ms) {
            if (late_to_search()) return ++untimed_, false;
            report_progress(name_of(c.axis_values) + ", timing");
            time_until_decided(c);
        }
        const std::optional<bool> before = c.holds;
        decide(c);
        if (c.holds != before) show_so_far();
        return c.holds.value_or(false);
    }
    /// Decides whether a case is within the limits, as far as its error and its time are known.
    void decide(AutopilotCase& c) const {
        if (!accurate(c))
            c.holds = false;
        else if (c.ms && (!goals_.max_ms || *c.ms + c.ms_noise <= *goals_.max_ms))
            c.holds = true;
        else if (c.ms && *c.ms - c.ms_noise > *goals_.max_ms)
            c.holds = false;
    }
    /// Times a case again while the limit lies within the noise of its time.
    void time_until_decided(AutopilotCase& c) const {
        double sum = 0;
        for (int n = 1; n <= kMaxTimings; ++n) {
            const CostChange time = meter_.ms(c.settings);
            sum += time.value;
            c.ms = sum / n;
            c.ms_noise = time.noise / std::sqrt(n);
            if (!goals_.max_ms || std::abs(*c.ms - *goals_.max_ms) >= c.ms_noise || late_to_search()) return;
        }
    }

    /// Returns true when another case with the same kernel does less work and no more of any kind.
    static bool outdone(const AutopilotCase& c, const std::vector<AutopilotCase*>& others) {
        const auto no_more = [](const WorkCost& a, const WorkCost& b) {
            return a.map_texels <= b.map_texels && a.map_bytes <= b.map_bytes && a.bytes_touched <= b.bytes_touched &&
                   a.draws <= b.draws && a.triangles <= b.triangles;
        };
        return std::any_of(others.begin(), others.end(), [&](const AutopilotCase* o) {
            return o->settings.filter == c.settings.filter &&
                   o->classified.work.bytes_touched < c.classified.work.bytes_touched &&
                   no_more(o->classified.work, c.classified.work);
        });
    }

    /// Returns a stride that visits all cases in a spread-out order, so that those within the time are evenly chosen.
    static std::size_t stride_over(std::size_t count) {
        std::size_t stride = std::max<std::size_t>(1, std::size_t(0.618 * double(count)));
        while (std::gcd(stride, count) != 1) ++stride;
        return stride;
    }

    double cost_of_case(const AutopilotCase& c) const { return goals_.max_error ? *c.ms : c.classified.error; }

    /// Returns the best case within the limits; null: none.
    AutopilotCase* best_of(std::vector<AutopilotCase*> cases) {
        std::erase_if(cases, [&](const AutopilotCase* c) { return !accurate(*c); });
        // Without an error limit, the first case that is fast enough is the most accurate.
        const auto order = [&](const AutopilotCase* a, const AutopilotCase* b) {
            return goals_.max_error ? a->classified.work.bytes_touched < b->classified.work.bytes_touched
                                    : a->classified.error < b->classified.error;
        };
        std::stable_sort(cases.begin(), cases.end(), order);
        AutopilotCase* best = nullptr;
        for (AutopilotCase* c : cases) {
            if (goals_.max_error && outdone(*c, cases)) continue;
            if (!time_it(*c)) continue;
            if (!best || cost_of_case(*c) < cost_of_case(*best)) best = c;
            if (!goals_.max_error) break;
        }
        return goals_.max_error ? settle(best, cases) : best;
    }

    /// Times cases of similar speed against the best one alternately, as separate times are less precise.
    AutopilotCase* settle(AutopilotCase* best, const std::vector<AutopilotCase*>& cases) {
        if (!best) return nullptr;
        std::vector<AutopilotCase*> close;
        for (AutopilotCase* c : cases)
            if (c != best && c->holds.value_or(false) && *c->ms < (1 + kMaxTieShare) * *best->ms) close.push_back(c);
        std::sort(close.begin(), close.end(), [](const auto* a, const auto* b) { return *a->ms < *b->ms; });
        if (close.size() > kFinalists) close.resize(kFinalists);
        for (AutopilotCase* c : close) {
            if (late_to_search()) break;
            report_progress(name_of(c->axis_values) + ", against the best");
            const CostChange more = meter_.time(best->settings, c->settings);
            if (more.is_significant() && more.value < 0) best = c;
        }
        return best;
    }

    std::vector<std::size_t> all_axes() const {
        std::vector<std::size_t> all(axes_.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
        return all;
    }

    /// Searches all combinations of some axes, with the others unchanged. Moves to the best case; returns true when it
    /// is within the limits.
    bool search_block(const std::vector<std::size_t>& block) {
        std::vector<AxisChoice> choices = {at_};
        for (const std::size_t axis : block) {
            std::vector<AxisChoice> more;
            for (const AxisChoice& c : choices)
                for (std::size_t v = 0; v < axes_[axis].values.size(); ++v) {
                    more.push_back(c);
                    more.back()[axis] = v;
                }
            choices = std::move(more);
        }
        std::vector<AutopilotCase*> cases;
        for (std::size_t i = 0; i < choices.size(); ++i)
            if (AutopilotCase* found = classified(choices[i * stride_over(choices.size()) % choices.size()]))
                cases.push_back(found);
            else
                unmeasured_.insert(choices[i * stride_over(choices.size()) % choices.size()]);
        const AutopilotCase* best = best_of(cases);
        if (!best && !cases.empty()) best = nearest(cases);
        if (best) at_ = best->axis_values;
        return best && best->holds.value_or(false);
    }

    /// Returns the case nearest to the limits.
    const AutopilotCase* nearest(const std::vector<AutopilotCase*>& cases) const {
        const auto missed = [&](const AutopilotCase* c) {
            const double error = goals_.max_error ? std::max(c->classified.error / *goals_.max_error, 1.0) : 1;
            const double ms = goals_.max_ms && c->ms ? std::max(*c->ms / *goals_.max_ms, 1.0) : 1;
            // Cases without a time come last.
            return std::pair(goals_.max_ms && !c->ms ? 1 : 0, error * ms);
        };
        return *std::min_element(cases.begin(), cases.end(),
                                 [&](const auto* a, const auto* b) { return missed(a) < missed(b); });
    }

    /// Searches two axes at a time, kernel and resolution first, since one may pay off only with another, such as
    /// cascades with a lower resolution.
    void search_by_parts() {
        std::vector<std::size_t> axes = all_axes();
        const auto rank = [&](std::size_t i) {
            return axes_[i].key == "map.resolution" ? 0 : axes_[i].key == "filter.kernel" ? 1 : 2;
        };
        std::stable_sort(axes.begin(), axes.end(), [&](auto a, auto b) { return rank(a) < rank(b); });
        for (int pass = 0; pass < 3 && !late_to_search(); ++pass) {
            const AxisChoice before = at_;
            for (std::size_t i = 0; i < axes.size(); ++i)
                for (std::size_t k = i + 1; k < axes.size() && !late_to_search(); ++k) search_block({axes[i], axes[k]});
            if (at_ == before) break;
        }
    }

    void find_dropped(AutopilotResult& out) {
        std::string unpriced;
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            const std::string& key = axes_[i].key;
            SettingContribution d{key, value_of(start_, key), value_of(out.best.settings, key)};
            if (d.before == d.now) continue;
            if (!price(d, out.best.settings)) {
                unpriced += (unpriced.empty() ? "" : ", ") + key;
                continue;
            }
            out.dropped.push_back(std::move(d));
        }
        if (!unpriced.empty())
            out.untried.push_back(fmt::format("the cost of {} was not measured: no time left", unpriced));
    }

    /// Measures error and time of a dropped setting on the best settings. Returns false when there is no time left.
    bool price(SettingContribution& d, const Settings& best) const {
        if (late()) return false;
        report_progress("the cost of " + d.key);
        Settings with = best;
        set_setting(with, d.key, d.before);
        if (d.key == "filter.kernel") {
            with.filter = start_.filter;
            with.bias = start_.bias;
        }
        d.error = meter_.measure(with, start_.view.light).error;
        if (late()) return false;
        d.ms = meter_.time(best, with);
        return true;
    }

    bool holds(const AxisChoice& at) const {
        const auto it = known_.find(at);
        return it != known_.end() && it->second.holds.value_or(false);
    }

    void finish(AutopilotResult& out) {
        std::vector<AutopilotCase*> cases;
        for (auto& [at, c] : known_) cases.push_back(&c);
        if (out.stopped) {
            // The search had no time to move to the best case.
            for (const AutopilotCase* c : cases)
                if (c->holds.value_or(false) && (!holds(at_) || cost_of_case(*c) < cost_of_case(known_.at(at_))))
                    at_ = c->axis_values;
        }
        const auto best = known_.find(at_);
        if (best != known_.end() && best->second.holds.value_or(false)) {
            out.best = best->second;
            out.goals_met = true;
        } else if (!cases.empty())
            out.best = *nearest(cases);
        if (out.goals_met && !out.stopped) find_dropped(out);
        if (!unmeasured_.empty())
            out.untried.push_back(fmt::format("{} combinations were not measured: no time left", unmeasured_.size()));
        if (untimed_ > 0)
            out.untried.push_back(
                fmt::format("{} combinations within the error limit were not timed: no time left", untimed_));
        for (const auto* c : cases) out.cases.push_back(*c);
        out.summary = summary_of(out);
        out.seconds = spent_s();
    }

    std::string bounds() const {
        std::string text;
        if (goals_.max_error) text = fmt::format("{} at most {}", goals_.error->key, digits_text(*goals_.max_error));
        if (goals_.max_ms)
            text += fmt::format("{}{} ms at most {}", text.empty() ? "" : " and ", digits_text(*goals_.max_ms),
                                cost_row(goals_.cost).when);
        return text;
    }

    std::string summary_of(const AutopilotResult& out) const {
        if (out.cases.empty()) return fmt::format("{} cannot be met: there was no time to try anything", bounds());
        const std::string ms =
            out.best.ms ? fmt::format(", {} ms a frame {}", digits_text(*out.best.ms), cost_row(goals_.cost).when) : "";
        const std::string found = fmt::format("{}: {} {:.4g}{}", name_of(out.best.axis_values), goals_.error->key,
                                              out.best.classified.error, ms);
        if (!out.goals_met && out.stopped && accurate(out.best) && !out.best.ms)
            return fmt::format("stopped before a combination with {} was timed; one that was not is {}", bounds(),
                               found);
        if (!out.goals_met)
            return fmt::format("{} {} by any tried combination; the nearest is {}", bounds(),
                               out.stopped ? "is not met so far" : "cannot be met", found);
        return fmt::format("{} (now {:.4g}, {} ms)", found, out.before.error, digits_text(out.before_ms));
    }
};

}  // namespace

std::vector<SweepAxis> autopilot_axes(const Settings& s, const AdviceFacts& f, int max_resolution) {
    std::vector<SweepAxis> axes;
    const auto offer = [&](const std::string& key, const std::vector<std::string>& values) {
        SweepAxis axis{key, {""}};
        const std::string now = value_of(s, key);
        for (const std::string& v : values)
            if (v != now) axis.values.push_back(v);
        if (axis.values.size() > 1) axes.push_back(std::move(axis));
    };
    const std::string light = fmt::format("light.{}.", f.light);
    for (std::size_t i = 0; i < f.lights.size(); ++i)
        if (f.lights[i].shadowed && f.shadowed[i] == 0) offer(fmt::format("light.{}.cast", i), {"false"});
    if (s.lights[std::size_t(f.light)].contact > 0) offer(light + "contact", {"0"});
    const FittedLight* fitted = f.fitted();
    if (!fitted || !fitted->casts) return axes;
    offer("filter.kernel", {sweep_kernels().begin(), sweep_kernels().end()});
    std::vector<std::string> sizes;
    for (int n = 256; n <= std::min(max_resolution, 4096); n *= 2) sizes.push_back(std::to_string(n));
    if (fitted->provider == MapProvider::Imported) {
        if (s.map.blur_texels > 0) offer("map.blur_texels", {"0"});
        return axes;
    }
    offer("map.resolution", sizes);
    if (s.map.paged) offer("map.virtual", {"false"});
    if (fitted->type == LightType::Directional && !fitted->is_perspective() && !s.map.paged)
        offer(light + "cascades", {"1", "2", "4"});
    if (s.lights[std::size_t(f.light)].cascades > 1) offer(light + "cascade_blend", {"0"});
    if (fitted->views.size() == 1 && (fitted->type == LightType::Directional) != fitted->is_perspective())
        offer(light + "fit", {"casters", "view"});
    offer("map.format", {"d16"});
    if (s.map.blur_texels > 0) offer("map.blur_texels", {"0"});
    return axes;
}

void remove_refused(std::vector<SweepAxis>& axes, const EngineProfile* engine, const Settings& base) {
    if (!engine) return;
    const auto is_refused = [&](const std::string& key, const std::string& value) {
        if (value.empty()) return false;
        Settings with = base;
        set_setting(with, key, value);
        return !reason_engine_lacks(*engine, base, with).empty();
    };
    for (SweepAxis& axis : axes)
        std::erase_if(axis.values, [&](const std::string& value) { return is_refused(axis.key, value); });
    std::erase_if(axes, [](const SweepAxis& axis) { return axis.values.empty(); });
}

AutopilotResult run_autopilot(const Settings& settings, const std::vector<SweepAxis>& axes, const AutopilotGoals& goals,
                              const TrialMeter& meter, const TrialReport& report, const AutopilotShow& show) {
    return AutopilotSearch(settings, axes, goals, meter, report, show).run();
}

AutopilotResult run_rendered_autopilot(const SearchTools& whole, const Settings& settings, const AutopilotGoals& goals,
                                       std::vector<SweepAxis> axes, const AutopilotShow& show) {
    const SearchTools tools = whole.part();
    const Settings base = measured_settings(settings);
    tools.report(0, "the present settings");
    if (axes.empty()) axes = autopilot_axes(base, advice_facts(tools, base), tools.renderer.driver().max_texture_size);
    remove_refused(axes, tools.engine, base);
    return run_autopilot(base, axes, goals, renderer_trial_meter(tools, {.error = goals.error, .cost = goals.cost}),
                         tools.report, show);
}

}  // namespace si
