// The least bias that leaves no acne in a frame: predicted by theory, found by measuring. Says what to measure next and
// draws nothing itself.
//
//     BiasSearch search(settings);
//     while (!search.done()) {
//         const ErrorTask task = error_task(renderer, scene, search.next(), request, light);   // renderer's thread
//         search.report(judge_bias(task, search.next(), cache, renderer.driver()));        // any one thread
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
    /// Pixels away from true edges that are dark though lit, and with wide kernels those whose surface darkens itself
    /// faintly, long before that counts as shadow.
    std::size_t acne() const;
    /// Pixels away from true edges that are lit though dark.
    std::size_t leaks() const;
};

/// Compares a frame with the truth. @param settings that the task was made with. @throws Cancelled, Error
BiasTrial judge_bias(const ErrorTask& task, const Settings& settings, TruthCache& cache, const RasterTraits& driver,
                     const Workers& workers = {});

struct BiasFound {
    BiasFamily family = BiasFamily::Constant;
    double factor = 1;  ///< of what theory says; a normal offset is given texels of constant bias where that is not enough
    BiasSettings bias;
    BiasTrial trial;
};

class BiasSearch {
public:
    struct Options {
        double tolerance = 0.02;             ///< the least factor is known to this share
        std::optional<BiasFamily> only;      ///< else all are tried
        bool quick = false;                  ///< content with what theory says where that leaves no acne
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
    /// The one that loses the fewest pixels to leaks, and of about equal ones that with the smallest gap; nothing when no
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
    std::vector<BiasFound> found_;
    std::optional<BiasFound> clear_, nearest_;
};

/// How it compares with theory: "0.97 of what theory says".
std::string theory_text(const BiasFound& found);

/// The bias in words: "bias.normal 3.1, bias.constant 0.02 texels".
std::string bias_text(const BiasSettings& bias);

}  // namespace si
