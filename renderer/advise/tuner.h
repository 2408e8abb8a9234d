// Tuner: searches the least bias, and with limits also kernel and resolution, for the most accurate or cheapest
// settings. The tuner returns the settings to measure next and draws nothing.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/advise/bias_search.h"
#include "renderer/measure/frame_costs.h"

namespace si {

/// Returns the reason why the bias of a light cannot be tuned, such as a light without a map; empty: it can.
/// @param light index of light.*
std::string reason_not_tunable(std::span<const FittedLight> lights, int light);

/// Goals of a Tuner: limits of error and frame time, and the largest resolution.
struct TuneGoals {
    std::optional<double> max_error, max_ms;   ///< limits; without any, only bias is searched
    const Metric* error = &metrics().front();  ///< metric of max_error; not Better::Neither
    int max_resolution = 8192;                 ///< largest map.resolution to try
    CostCase cost = kDefaultCost;              ///< kind of frames that are timed for max_ms
    /// Returns true when there is a limit of error or time.
    bool any() const { return max_error || max_ms; }
};

/// Kernel and resolution that the tuner tried, with the least bias for them.
struct TuneCandidate {
    std::string_view kernel;  ///< value of filter.kernel
    Settings settings;
    std::optional<BiasTrial> trial;
    double error = 0;          ///< distance_from_best() of TuneGoals::error
    std::optional<double> ms;  ///< frame time
    bool clear = false;        ///< without acne
    bool meets = false;        ///< without acne, and within the limits
};

/// Search for the least bias, and with limits also for kernel and resolution. The caller measures settings() as
/// action() requests, until Action::None.
class Tuner {
public:
    /// Begins a search for the least bias, and with limits for kernel and resolution. @param start the settings whose
    /// bias, kernel and resolution are replaced
    Tuner(const Settings& start, const TuneGoals& goals);

    /// Measurement that the tuner needs next.
    enum class Action {
        Classify,  ///< error of a frame, for add_trial()
        Time,      ///< frame time, for add_time()
        None,      ///< done
    };
    /// Returns the measurement that the tuner needs next, of settings().
    Action action() const { return action_; }
    /// Returns the settings to measure next.
    Settings settings() const;
    /// Adds the error measurement that Action::Classify requested.
    void add_trial(const BiasTrial& trial);
    /// Adds the frame time that Action::Time requested. @param ms milliseconds
    void add_time(double ms);

    /// Returns the estimated share of the tuner's search that is done, 0..1.
    double progress() const;
    /// Returns the present step of the tuner for people: "PCF 3x3 at 1024², timing".
    std::string step_label() const;
    /// Returns the number of error measurements so far.
    int trials() const { return trials_; }
    /// Returns the search for the least bias at the start's kernel and resolution.
    const BiasSearch& bias() const { return first_; }
    /// Returns the kernels and resolutions that were tried; empty without limits.
    const std::vector<TuneCandidate>& candidates() const { return candidates_; }
    /// Returns the best candidate within all limits: with max_error the cheapest, else the most accurate. Null: none.
    const TuneCandidate* best() const;
    /// Returns the start settings with the bias, kernel and resolution that were found; none: no candidate is without
    /// acne and within the limits.
    std::optional<Settings> result() const;
    /// Returns the tuner's result in one sentence: the settings and their cost, or the reason why there are none.
    std::string summary() const;

private:
    static constexpr int kMinResolution = 256;

    /// Begins the search for the bias of the kernel and resolution that kernel_ and resolution_ name, or ends all
    /// searches after the last kernel.
    void open_candidate();
    /// Ends the trial of the present kernel and resolution, and begins the next one. @param try_finer true: continues
    /// with twice the resolution if goals_ allow it; else with the next kernel
    void close_candidate(bool try_finer);
    /// Takes the bias that was found, rates the candidate against the limits, and then requests its time or closes it.
    void finish_measured_run();

    Settings start_;
    TuneGoals goals_;
    BiasSearch first_;
    std::optional<BiasSearch> search_;  ///< search of the present candidate
    Action action_ = Action::Classify;
    std::size_t kernel_ = 0;
    int resolution_ = kMinResolution;
    int trials_ = 0;
    std::vector<TuneCandidate> candidates_;
};

}  // namespace si
