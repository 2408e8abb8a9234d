#include "renderer/advise/bias_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/base/lengths_text.h"

namespace si {

std::size_t BiasTrial::acne() const {
    return error.artefacts[std::size_t(Artefact::Acne)] + needs.faint_acne;
}

std::size_t BiasTrial::lost() const {
    const auto pixels = [&](Artefact a) { return error.artefacts[std::size_t(a)]; };
    return pixels(Artefact::PeterPanning) + pixels(Artefact::PeterPanningOffset) +
           pixels(Artefact::PeterPanningRaster) + pixels(Artefact::OffsetShadow);
}

std::size_t BiasTrial::wrong() const {
    return std::accumulate(error.artefacts.begin() + 1, error.artefacts.end(), std::size_t(0));
}

BiasTrial measure_bias_trial(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver) {
    return {measured.metrics, bias_needs(measured, settings, driver)};
}

BiasSearch::BiasSearch(const Settings& start, const Options& options) : start_(start), options_(options) {
    if (options.only)
        families_ = {*options.only};
    else
        families_ = {BiasFamily::Normal, BiasFamily::Slope, BiasFamily::Constant};
}

// Planes need factor 1. Next to a rising surface (a wall above its floor), more normal offset only moves along the
// wall, so texels of constant bias are added instead.
BiasSettings BiasSearch::bias_at_factor(double factor) const {
    const BiasFamily family = families_[at_];
    const BiasSettings& theory = before_.needs.least_of(family);
    if (family != BiasFamily::Normal || factor <= 1) return scale_bias(theory, factor);
    BiasSettings bias = theory;
    bias.constant += factor - 1;
    return scale_bias(bias, 1);
}

Settings BiasSearch::next_settings() const {
    Settings s = start_;
    if (step_ == Step::Family) s.bias = bias_at_factor(factor_);
    return s;
}

std::string BiasSearch::step_label() const {
    if (step_ == Step::Before) return "the present bias";
    if (step_ == Step::Done) return "done";
    return fmt::format("{}: {}", family_label(families_[at_]), bias_text(next_settings().bias));
}

double BiasSearch::progress() const {
    if (step_ == Step::Done) return 1;
    if (step_ == Step::Before) return 0;
    constexpr double kUsual = 7;  // usual number of trials per family
    const double within = std::min(trials_of_family_ / kUsual, 0.95);
    return 0.05 + 0.95 * (double(at_) + within) / double(families_.size());
}

void BiasSearch::start_family(std::size_t index) {
    if (nearest_of_family_) tried_.push_back(*nearest_of_family_);
    nearest_of_family_.reset();
    at_ = index;
    factor_ = 1;
    lo_ = hi_ = 0;
    trials_of_family_ = 0;
    clear_.reset();
    if (at_ == families_.size()) step_ = Step::Done;
}

void BiasSearch::add_trial(const BiasTrial& trial) {
    ++trials_;
    if (step_ == Step::Before) {
        before_ = trial;
        step_ = trial.needs.pixels > 0 ? Step::Family : Step::Done;  // without lit pixels there is no acne
        if (step_ == Step::Family) start_family(0);
        return;
    }
    ++trials_of_family_;
    const BiasFound here{families_[at_], factor_, next_settings().bias, trial};
    if (trial.acne() == 0) clear_ = here;
    if (!nearest_ || trial.acne() < nearest_->trial.acne()) nearest_ = here;
    // The last trial without acne has the least bias.
    if (!nearest_of_family_ || trial.acne() == 0 || trial.acne() < nearest_of_family_->trial.acne())
        nearest_of_family_ = here;
    narrow(trial.acne() == 0);
}

// Lowers a factor without acne, raises one with acne, then bisects between the two.
void BiasSearch::narrow(bool clear) {
    const BiasSettings before = next_settings().bias;
    (clear ? hi_ : lo_) = factor_;
    const bool known = hi_ > 0 && (options_.quick || hi_ - lo_ <= options_.tolerance * hi_ || hi_ < 1e-3);
    if (known) {
        found_.push_back(*clear_);
        nearest_of_family_ = clear_;
        start_family(at_ + 1);
        return;
    }
    if (hi_ == 0) {
        const bool normal = families_[at_] == BiasFamily::Normal;
        factor_ = normal ? 1 + std::max(0.25, 2 * (lo_ - 1)) : 1.25 * lo_;
        // At the limits of the settings a larger factor changes nothing.
        if (factor_ > (normal ? 130 : 16) || next_settings().bias == before) start_family(at_ + 1);
    } else if (lo_ == 0) {
        factor_ = hi_ == 1 ? 0.93 : 0.75 * hi_;
    } else {
        factor_ = 0.5 * (lo_ + hi_);
    }
}

const BiasFound* BiasSearch::best() const {
    const auto better = [](const BiasFound& a, const BiasFound& b) {
        const std::size_t lost_a = a.trial.lost(), lost_b = b.trial.lost();
        return lost_a != lost_b ? lost_a < lost_b : a.trial.needs.gap_p95_m < b.trial.needs.gap_p95_m;
    };
    const auto it = std::min_element(found_.begin(), found_.end(), better);
    return it == found_.end() ? nullptr : &*it;
}

std::string theory_text(const BiasFound& found) {
    if (found.family == BiasFamily::Normal && found.factor > 1)
        return fmt::format("the bias by theory for planes, and {:.2g} texels for corners", found.factor - 1);
    return fmt::format("{:.2f} of the bias by theory", found.factor);
}

std::string bias_text(const BiasSettings& b) {
    std::string text;
    const auto add = [&](const char* key, double value) {
        if (value > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, digits_text(value));
    };
    add("bias.normal", b.normal);
    add("bias.slope", b.slope);
    add("bias.constant", b.constant);
    if (text.empty()) return "no bias";
    return text + (b.unit == BiasUnit::Texels ? " texels" : b.unit == BiasUnit::Metres ? " m" : "");
}

}  // namespace si
