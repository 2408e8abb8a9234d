// The least bias that leaves no acne in a frame: predicted by theory, found by measuring. Says what to measure next and
// draws nothing itself.
//
//     BiasSearch search(settings);
//     while (!search.done()) {
//         const MeasuredError measured = measure_error(renderer, scene, search.next(), request, light, {}, cache);
//         search.report(measure_bias_trial(measured, search.next(), driver));
//     }
//     search.best()->bias
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/measure/bias_needs.h"

namespace si {

/// What a frame under some bias showed.
struct BiasTrial {
    ErrorMetrics error;
    BiasNeeds needs;
    /// Pixels that are dark though lit and that more bias puts right, and with wide kernels those whose surface darkens
    /// itself faintly, long before that counts as shadow.
    std::size_t acne() const;
    /// The price of bias: pixels that are wrong, and would be right if each had just the least bias of its own.
    std::size_t lost() const;
    /// Pixels that are wrong for whatever cause.
    std::size_t wrong() const;
};

/// What was measured, as a search takes it. @param settings that were measured
BiasTrial measure_bias_trial(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver);

struct BiasFound {
    BiasFamily family = BiasFamily::Constant;
    double factor =
        1;  ///< of what theory says; a normal offset is given texels of constant bias where that is not enough
    BiasSettings bias;
    BiasTrial trial;
};

class BiasSearch {
public:
    struct Options {
        double tolerance = 0.02;         ///< the least factor is known to this share
        std::optional<BiasFamily> only;  ///< else all are tried
        bool quick = false;              ///< content with what theory says where that leaves no acne
    };
    /// @param start with the bias that is to be replaced; it is tried first
    explicit BiasSearch(const Settings& start) : BiasSearch(start, Options()) {}
    BiasSearch(const Settings& start, const Options& options);

    bool done() const { return step_ == Step::Done; }
    /// What to measure next.
    Settings next() const;
    void report(const BiasTrial& trial);
    double progress() const;
    /// "normal offset, 3.1 texels".
    std::string about() const;
    int trials() const { return trials_; }

    const BiasTrial& before() const { return before_; }
    /// The least of each family that leaves no acne; families that never do are missing.
    const std::vector<BiasFound>& found() const { return found_; }
    /// One of each family that was tried: the least that leaves no acne, or else what came nearest to that.
    const std::vector<BiasFound>& tried() const { return tried_; }
    /// The one that loses the fewest pixels, and of equal ones that with the smallest gap for 95 %; nothing when no
    /// bias leaves no acne.
    const BiasFound* best() const;
    /// Where none does: what came nearest.
    const BiasFound* nearest() const { return nearest_ ? &*nearest_ : nullptr; }

private:
    enum class Step { Before, Family, Done };
    BiasSettings tried(double factor) const;
    void start_family(std::size_t index);
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

/// How it compares with theory: "0.97 of what theory says".
std::string theory_text(const BiasFound& found);

/// The bias in words: "bias.normal 3.1, bias.constant 0.02 texels".
std::string bias_text(const BiasSettings& bias);

}  // namespace si
