#include "renderer/advise/tuner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/lengths_text.h"
#include "renderer/settings/filters.h"

namespace si {
std::string reason_not_tunable(std::span<const FittedLight> lights, int light) {
    const auto i = std::size_t(std::max(light, 0));
    if (i >= lights.size()) return fmt::format("there is no light {}: there is no bias to find", i);
    if (lights[i].casts) return {};
    return fmt::format("light {} draws no shadow map ({}): there is no bias to find", i, lights[i].reason);
}

namespace {

std::string cost_text(const BiasTrial& before, const BiasTrial& after) {
    std::string text = fmt::format(
        "gap at casters {} at the median, {} for 95 % (was {}, {}); {} px lost to bias (was {}); acne {} px (was "
        "{})",
        metres_text(after.needs.gap_median_m), metres_text(after.needs.gap_p95_m),
        metres_text(before.needs.gap_median_m), metres_text(before.needs.gap_p95_m), after.lost(), before.lost(),
        after.acne(), before.acne());
    if (after.needs.folds > 0)
        text += fmt::format("; {} px stay a little darker in concave corners", after.needs.folds);
    return text;
}

}  // namespace

Tuner::Tuner(const Settings& start, const TuneGoals& goals) : start_(start), goals_(goals), first_(start) {}

Settings Tuner::settings() const {
    if (action_ == Action::Time) return candidates_.back().settings;
    return search_ ? search_->next_settings() : first_.next_settings();
}

void Tuner::open_candidate() {
    if (kernel_ == sweep_kernels().size()) {
        search_.reset();
        action_ = Action::None;
        return;
    }
    Settings s = start_;
    // The search begins with the bias of the start, scaled to this kernel's reach.
    const BiasFound& known = *first_.best();
    set_setting(s, "filter.kernel", sweep_kernels()[kernel_]);
    s.bias = scale_bias(known.bias, std::max(reach_of(s).bias, 0.5) / std::max(reach_of(start_).bias, 0.5));
    s.map.resolution = resolution_;
    candidates_.push_back({.kernel = sweep_kernels()[kernel_], .settings = s});
    search_.emplace(s, BiasSearch::Options{.only = known.family, .quick = true});
    action_ = goals_.max_ms ? Action::Time : Action::Classify;  // timing is cheaper than tracing
}

void Tuner::close_candidate(bool try_finer) {
    if (try_finer && 2 * resolution_ <= goals_.max_resolution) {
        resolution_ *= 2;
    } else {
        ++kernel_;
        resolution_ = std::min(kMinResolution, goals_.max_resolution);
    }
    open_candidate();
}

void Tuner::finish_measured_run() {
    TuneCandidate& c = candidates_.back();
    const BiasFound* found = search_->best() ? search_->best() : search_->nearest();
    c.clear = search_->best() != nullptr;
    if (found) {
        c.settings.bias = found->bias;
        c.trial = found->trial;
    } else {
        c.trial = search_->before();
        c.clear = true;  // no pixel is lit
    }
    c.error = distance_from_best(goals_.error->better, goals_.error->value(c.trial->error));
    const bool accurate = c.clear && (!goals_.max_error || c.error <= *goals_.max_error);
    if (!c.ms && accurate) {
        action_ = Action::Time;
        return;
    }
    c.meets = accurate && c.ms && (!goals_.max_ms || *c.ms <= *goals_.max_ms);
    // Finer maps cost more and are not needed once the error is small enough.
    close_candidate(!(goals_.max_error && c.meets));
}

void Tuner::add_trial(const BiasTrial& trial) {
    ++trials_;
    if (!search_) {
        first_.add_trial(trial);
        if (!first_.done()) return;
        if (!goals_.any() || !first_.best())
            action_ = Action::None;
        else
            open_candidate();
        return;
    }
    search_->add_trial(trial);
    if (search_->done()) finish_measured_run();
}

void Tuner::add_time(double ms) {
    TuneCandidate& c = candidates_.back();
    c.ms = ms;
    if (c.trial) {
        finish_measured_run();
    } else if (goals_.max_ms && ms > *goals_.max_ms) {
        close_candidate(false);  // finer maps cost more
    } else {
        action_ = Action::Classify;
    }
}

double Tuner::progress() const {
    if (action_ == Action::None) return 1;
    const double first = goals_.any() ? 0.2 : 1.0;
    if (!search_) return first * first_.progress();
    const double steps = std::log2(double(goals_.max_resolution) / kMinResolution) + 1;
    const double within = std::log2(double(resolution_) / kMinResolution) / steps;
    return first + (1 - first) * (double(kernel_) + within) / double(sweep_kernels().size());
}

std::string Tuner::step_label() const {
    if (!search_) return first_.step_label();
    return fmt::format("{} at {}²{}", kernel_label(candidates_.back().settings), resolution_,
                       action_ == Action::Time ? ", timing" : "");
}

const TuneCandidate* Tuner::best() const {
    const TuneCandidate* best = nullptr;
    for (const TuneCandidate& c : candidates_) {
        if (!c.meets) continue;
        const auto cost = [&](const TuneCandidate& t) { return goals_.max_error ? *t.ms : t.error; };
        if (!best || cost(c) < cost(*best)) best = &c;
    }
    return best;
}

std::optional<Settings> Tuner::result() const {
    if (goals_.any()) {
        if (const TuneCandidate* c = best()) return c->settings;
        return {};
    }
    const BiasFound* found = first_.best();
    if (!found) return {};
    Settings s = start_;
    s.bias = found->bias;
    return s;
}

std::string Tuner::summary() const {
    if (first_.before().needs.pixels == 0) return "nothing in the picture is lit within the map: no bias is needed";
    const BiasFound* found = first_.best();
    if (!found) {
        const BiasFound* near = first_.nearest();
        return fmt::format("no bias leaves no acne: {} px remain under {}; a finer map or format is needed",
                           near->trial.acne(), bias_text(near->bias));
    }
    if (!goals_.any())
        return fmt::format("least bias without acne: {} ({}); {}", bias_text(found->bias), theory_text(*found),
                           cost_text(first_.before(), found->trial));
    if (const TuneCandidate* c = best())
        return fmt::format("{} at {}², {}: {} {:.4g}, {} ms a frame {}; {}", kernel_label(c->settings),
                           c->settings.map.resolution, bias_text(c->settings.bias), goals_.error->key, c->error,
                           digits_text(*c->ms), cost_row(goals_.cost).when, cost_text(first_.before(), *c->trial));
    const TuneCandidate* near = nullptr;
    for (const TuneCandidate& c : candidates_)
        if (c.trial && c.clear && (!near || c.error < near->error)) near = &c;
    if (!near) return "no kernel and resolution is within the limits: each takes longer than allowed or shows acne";
    return fmt::format("no kernel and resolution is within the limits: the least {} was {:.4g} with {} at {}²{}",
                       goals_.error->key, near->error, kernel_label(near->settings), near->settings.map.resolution,
                       near->ms ? fmt::format(" in {} ms {}", digits_text(*near->ms), cost_row(goals_.cost).when) : "");
}

}  // namespace si
