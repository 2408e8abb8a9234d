// Search for the least bias without acne in a frame: predicted by theory, confirmed by measured trials. The search
// returns the settings to measure next and draws nothing.
//
//     BiasSearch search(settings);
//     while (!search.done()) {
//         const Settings s = search.next_settings();
//         const MeasuredError measured = measure_error(renderer, scene, s, request, light, {}, cache);
//         search.add_trial(measure_bias_trial(measured, s, driver));
//     }
//     search.best()->bias
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/advise/bias_needs.h"

namespace si {

/// Measured frame under one bias: error metrics and the bias that the frame needs.
struct BiasTrial {
    ErrorMetrics error;
    BiasNeeds needs;
    /// Returns the number of pixels with acne, faint acne of wide kernels included. More bias makes them right.
    std::size_t acne() const;
    /// Returns the number of pixels that are wrong by too much bias: light that bias or normal offset lets in
    /// (peter-panning), and shadow that normal offset casts (OffsetShadow).
    std::size_t lost() const;
    /// Returns the number of wrong pixels of all causes.
    std::size_t wrong() const;
};

/// Makes a trial for BiasSearch::add_trial() from a measured frame: its error metrics, and the bias that its pixels
/// need. @param settings settings of the measured frame
BiasTrial measure_bias_trial(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver);

/// Bias that a search found for one family, with the trial that confirmed it.
struct BiasFound {
    BiasFamily family = BiasFamily::Constant;
    double factor = 1;  ///< multiple of the bias by theory; normal offset above 1: plus texels of constant bias
    BiasSettings bias;
    BiasTrial trial;
};

/// Search for the least bias without acne, by bisection within each bias family. The caller measures next_settings()
/// and adds the trial until done().
class BiasSearch {
public:
    /// Options of a search for the least bias.
    struct Options {
        double tolerance = 0.02;         ///< relative precision of the least factor
        std::optional<BiasFamily> only;  ///< family to search; none: all
        bool quick = false;              ///< accepts the bias by theory where no acne is left
    };
    /// Begins a search with default options. @param start the settings whose bias is replaced; measured first
    explicit BiasSearch(const Settings& start) : BiasSearch(start, Options()) {}
    /// Begins a search. @param start the settings whose bias is replaced; measured first
    BiasSearch(const Settings& start, const Options& options);

    /// Returns true when no further trial is needed.
    bool done() const { return step_ == Step::Done; }
    /// Returns the settings to measure next.
    Settings next_settings() const;
    /// Adds the measured trial of next_settings() and chooses the next settings.
    void add_trial(const BiasTrial& trial);
    /// Returns the estimated share of the bias search that is done, 0..1.
    double progress() const;
    /// Returns the present step of the bias search for people: "normal offset: bias.normal 3.1 texels".
    std::string step_label() const;
    /// Returns the number of added trials.
    int trials() const { return trials_; }

    /// Returns the trial of the start settings.
    const BiasTrial& before() const { return before_; }
    /// Returns the least bias without acne of each family; families without one are missing.
    const std::vector<BiasFound>& found() const { return found_; }
    /// Returns one bias for each searched family: the least without acne, else the one with the least acne.
    const std::vector<BiasFound>& tried() const { return tried_; }
    /// Returns the bias without acne that loses the fewest shadow pixels, then the one with the smallest gap at
    /// casters; null: no bias is without acne.
    const BiasFound* best() const;
    /// Returns the bias with the least acne of all trials; null: no trials.
    const BiasFound* nearest() const { return nearest_ ? &*nearest_ : nullptr; }

private:
    /// Stage of the search: start settings, a family, done.
    enum class Step { Before, Family, Done };
    /// Returns bias settings of the family that is searched now, `factor` times the least bias by theory.
    BiasSettings bias_at_factor(double factor) const;
    /// Begins the bisection of a family by its index in families_.
    void start_family(std::size_t index);
    /// Narrows the range of bias factors that the bisection still searches, after a trial. @param clear true: the trial
    /// had no acne
    void narrow(bool clear);

    Settings start_;
    Options options_;
    Step step_ = Step::Before;
    BiasTrial before_;
    std::vector<BiasFamily> families_;
    std::size_t at_ = 0;
    double factor_ = 1, lo_ = 0, hi_ = 0;  ///< acne at lo, none at hi; 0: not known
    int trials_ = 0, trials_of_family_ = 0;
    std::vector<BiasFound> found_, tried_;
    std::optional<BiasFound> clear_, nearest_, nearest_of_family_;
};

/// Formats a found bias as a multiple of the bias by theory: "0.97 of the bias by theory".
std::string theory_text(const BiasFound& found);

/// Formats bias settings: "bias.normal 3.1, bias.constant 0.02 texels".
std::string bias_text(const BiasSettings& bias);

}  // namespace si
