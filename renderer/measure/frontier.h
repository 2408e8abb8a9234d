// Which settings are worth their time: the frontier of error over cost, and the statistics that stand behind a dot.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace si {

/// Of a set of samples, such as the milliseconds of several frames.
struct Spread {
    double median = 0, p95 = 0, low = 0, high = 0;  ///< low and high: the extremes
    double median_low = 0, median_high = 0;  ///< 95 % confidence interval of the median, within one run of the program
    int samples = 0;
    int bursts = 0;  ///< that the samples were taken in
    /// Half the width of that interval as a share of the median; 1 when that says nothing.
    double relative() const;
    /// Half the width of that interval.
    double noise() const { return 0.5 * (median_high - median_low); }
};

/// Half the 95 % confidence interval of the mean of values that scatter normally, by Student's t; 0 of fewer than two.
double half_interval(const std::vector<double>& values);

/// The interval is the distribution-free one by ranks n/2 -+ 0.98 sqrt(n) (Conover, Practical Nonparametric Statistics,
/// 3.2), so that times that jump between two values do not pass for settled. Frames that follow each other are alike,
/// so that ranks alone take a machine's mood for certainty: with several bursts the interval is at least that of their
/// medians' mean by Student's t.
/// @param bursts index of the first sample of each; empty: one burst
Spread spread_of(std::vector<double> samples, std::span<const std::size_t> bursts = {});

/// A case on the plot. Smaller is better on both axes.
struct Dot {
    double cost = 0, error = 0;
    double cost_noise = 0, error_noise = 0;  ///< differences up to this are no differences
};

/// As alike as what has settled may be: noise beyond this share of a value is ignorance, which speaks for no dot.
inline constexpr double kMaxTieNoise = 0.03;

/// How `a` stands to `b`: better when it is no worse on either axis beyond noise (up to kMaxTieNoise) and better on one
/// beyond noise.
bool dominates(const Dot& a, const Dot& b);

/// For each dot whether nothing dominates it. Dots closer than noise do not push each other off. Dots with a value that
/// is not finite are never on the frontier.
std::vector<bool> frontier(std::span<const Dot> dots);

/// What else the frontier offers to the owner of `present`.
struct Advice {
    std::optional<std::size_t> better;  ///< least costly dot on the frontier with a smaller error: costs more
    double extra_cost = 0;
    std::optional<std::size_t> cheaper;  ///< least costly dot whose error is no larger: costs less
    double saved_cost = 0;
};
/// @param dots with `on_frontier` as frontier() gave it
Advice advise(const Dot& present, std::span<const Dot> dots, const std::vector<bool>& on_frontier);

/// The least-squares slope of log(error) over log(x) over the pairs in which both are positive and finite; nothing when
/// fewer than two distinct x are left. Hard shadows' boundary error falls with slope -1 over the resolution.
std::optional<double> log_slope(std::span<const double> x, std::span<const double> error);

}  // namespace si
