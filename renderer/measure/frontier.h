// Pareto frontier of shadow error over frame time, with the statistics of the measured values.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace si {

/// Statistics of repeated measurements, such as the milliseconds of several frames: median with confidence interval,
/// 95th percentile, extremes.
struct Spread {
    double median = 0, p95 = 0;
    double low = 0, high = 0;                ///< smallest and largest sample
    double median_low = 0, median_high = 0;  ///< 95 % confidence interval of the median, within one run of the program
    int samples = 0;                         ///< number of samples
    int bursts = 0;                          ///< number of bursts (runs of frames without a pause)
    /// Returns half the width of the median's confidence interval as a share of the median; 1 when unknown. Used to
    /// stop measuring when the median is precise enough.
    double relative() const;
    /// Returns half the width of the confidence interval of the median, in the unit of the samples.
    double noise() const { return 0.5 * (median_high - median_low); }
};

/// Returns a quantile of `values`, without interpolation: the value at the rank below. Returns `none` when there are no
/// values.
/// @param share the quantile, 0..1, such as 0.5 for the median
double lower_quantile(std::vector<double> values, double share, double none);
/// Returns half the width of the 95 % confidence interval of the mean of `values`, by Student's t for a normal
/// distribution. 0 for fewer than two values.
double half_interval(const std::vector<double>& values);

/// Computes the statistics of samples. The confidence interval is distribution-free, by ranks n/2 ± 0.98 sqrt(n)
/// (Conover, Practical Nonparametric Statistics, 3.2). It stays wide for times that jump between two values.
/// Consecutive frames are correlated. So from six bursts on, the ranked values are the bursts' medians. With fewer
/// bursts the ranked values are the samples, and the interval is at least the Student's t interval of the bursts'
/// medians.
/// @param bursts index of the first sample of each burst (run of frames without a pause); empty: one burst
Spread spread_of(std::vector<double> samples, std::span<const std::size_t> bursts = {});

/// Point of the frontier plot (error over cost): cost and error of a measured case, with the noise of each. Smaller is
/// better.
struct Dot {
    double cost = 0, error = 0;
    double cost_noise = 0, error_noise = 0;  ///< differences up to the noise do not count
};

/// Largest noise, as a share of the value, that lets a worse point of the frontier plot (error over cost) tie with a
/// better one.
inline constexpr double kMaxTieNoise = 0.03;

/// Returns true when point `a` of a frontier plot (error over cost) dominates point `b`. It is then better in cost or
/// error by more than the noise, and worse in neither by more than the noise. Where `a` is worse, at most kMaxTieNoise
/// of the value of `b` counts as noise.
bool dominates(const Dot& a, const Dot& b);

/// Computes the Pareto frontier of error and cost: for each point, true when no other point dominates it. Points closer
/// than noise do not dominate each other. Points with a value that is not finite are never on the frontier.
std::vector<bool> frontier(std::span<const Dot> dots);

/// Advice from a Pareto frontier for the present settings: one point with less error, and one point with less cost.
struct FrontierAdvice {
    std::optional<std::size_t> better;   ///< cheapest point with a smaller error, at more cost
    double extra_cost = 0;               ///< cost of `better` minus the present cost
    std::optional<std::size_t> cheaper;  ///< cheapest point with no larger error, at less cost
    double saved_cost = 0;               ///< present cost minus the cost of `cheaper`
};
/// Finds two points of a Pareto frontier that improve on the present settings by more than noise. One is the cheapest
/// point that costs more but has less error. The other is the cheapest point that costs less without more error.
/// @param present cost and error of the present settings
/// @param on_frontier for each of `dots`, true when it is on the frontier, as from frontier(dots)
FrontierAdvice frontier_advice(const Dot& present, std::span<const Dot> dots, const std::vector<bool>& on_frontier);

}  // namespace si
