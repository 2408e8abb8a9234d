// Searches bias, and with limits kernel and resolution too, for the setting that is least wrong or least costly. Says
// what to measure next and draws nothing itself.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/advise/bias_search.h"
#include "renderer/measure/frame_costs.h"

namespace si {

/// Why a light of a frame has no bias to search, in words; empty: it has.
std::string reason_not_tunable(std::span<const FittedLight> lights, int light);

struct TuneGoals {
    std::optional<double> max_error, max_ms;
    const Metric* error = &metrics().front();  ///< one that has a better
    int most_resolution = 8192;                ///< that may be tried
    CostCase cost = kDefaultCost;              ///< which frames max_ms bounds
    bool any() const { return max_error || max_ms; }
};

/// A kernel and resolution with the bias that it needs.
struct TuneCandidate {
    std::string_view kernel;  ///< as --set filter.kernel takes it
    Settings settings;
    std::optional<BiasTrial> trial;
    double error = 0;          ///< shortfall() of TuneGoals::error
    std::optional<double> ms;  ///< of a frame
    bool clear = false;        ///< no acne
    bool meets = false;        ///< clear, and within the limits
};

class Tuner {
public:
    Tuner(const Settings& start, const TuneGoals& goals);

    enum class Ask { Judge, Time, Nothing };
    /// What to do next with settings(), until Nothing.
    Ask ask() const { return ask_; }
    Settings settings() const;
    void classified(const BiasTrial& trial);
    void timed(double ms);

    double progress() const;
    std::string about() const;
    int trials() const { return trials_; }
    /// The least bias for the kernel and resolution of the start.
    const BiasSearch& bias() const { return first_; }
    /// Without limits empty.
    const std::vector<TuneCandidate>& candidates() const { return candidates_; }
    /// With a bound on the error the cheapest candidate within all limits, else the most accurate; nothing when none
    /// is.
    const TuneCandidate* best() const;
    /// The start with what was found; nothing when nothing leaves no acne within the limits.
    std::optional<Settings> result() const;
    /// One sentence: what was found, what it costs; or why nothing was.
    std::string summary() const;

private:
    static constexpr int kMinResolution = 256;

    void open_candidate();
    void close_candidate(bool try_finer);
    void finish_measured_run();

    Settings start_;
    TuneGoals goals_;
    BiasSearch first_;
    std::optional<BiasSearch> search_;  ///< of the present candidate
    Ask ask_ = Ask::Judge;
    std::size_t kernel_ = 0;
    int resolution_ = kMinResolution;
    int trials_ = 0;
    std::vector<TuneCandidate> candidates_;
};

}  // namespace si
