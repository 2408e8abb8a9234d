#include "renderer/measure/frontier.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace si {
namespace {

/// Smallest number of bursts whose medians are ranked. The smallest and the largest of six values enclose the median
/// with a probability of 97 %; of five, 94 %.
constexpr int kRankedBursts = 6;

/// Returns a quantile by linear interpolation between the two nearest ranks.
double quantile(const std::vector<double>& sorted, double q) {
    const double at = q * double(sorted.size() - 1);
    const auto below = std::size_t(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - double(below)) * (sorted[above] - sorted[below]);
}

double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return quantile(values, 0.5);
}

bool finite(const Dot& d) {
    return std::isfinite(d.cost) && std::isfinite(d.error);
}

}  // namespace

double lower_quantile(std::vector<double> values, double share, double none) {
    if (values.empty()) return none;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

double half_interval(const std::vector<double>& values) {
    static constexpr double kT[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
    const std::size_t n = values.size();
    if (n < 2) return 0;
    double mean = 0, squares = 0;
    for (const double v : values) mean += v / double(n);
    for (const double v : values) squares += (v - mean) * (v - mean);
    const std::size_t freedom = n - 1;
    const double t = freedom <= std::size(kT) ? kT[freedom - 1] : 1.96 + 2.7 / double(freedom);
    return t * std::sqrt(squares / double(freedom) / double(n));
}

double Spread::relative() const {
    if (samples < 2 || median <= 0) return 1;
    return 0.5 * (median_high - median_low) / median;
}

Spread spread_of(std::vector<double> samples, std::span<const std::size_t> bursts) {
    Spread s;
    s.samples = int(samples.size());
    if (samples.empty()) return s;
    std::vector<double> medians;
    for (std::size_t b = 0; b < bursts.size(); ++b) {
        const std::size_t end = b + 1 < bursts.size() ? bursts[b + 1] : samples.size();
        medians.push_back(
            median_of({samples.begin() + std::ptrdiff_t(bursts[b]), samples.begin() + std::ptrdiff_t(end)}));
    }
    s.bursts = std::max(1, int(medians.size()));
    std::sort(samples.begin(), samples.end());
    s.low = samples.front();
    s.high = samples.back();
    s.median = quantile(samples, 0.5);
    s.p95 = quantile(samples, 0.95);
    double between = 0;
    if (s.bursts >= kRankedBursts)
        std::sort(medians.begin(), medians.end());
    else
        between = half_interval(std::exchange(medians, samples));
    const auto n = double(medians.size());
    const auto rank = std::size_t(std::max(std::floor(0.5 * n - 0.98 * std::sqrt(n)), 0.0));
    s.median_low = std::max(std::min(medians[rank], s.median - between), 0.0);
    s.median_high = std::max(medians[medians.size() - 1 - rank], s.median + between);
    return s;
}

bool dominates(const Dot& a, const Dot& b) {
    if (!finite(a) || !finite(b)) return false;
    const double cost_noise = std::max(a.cost_noise, b.cost_noise),
                 error_noise = std::max(a.error_noise, b.error_noise);
    const bool no_worse = a.cost <= b.cost + std::min(cost_noise, kMaxTieNoise * b.cost) &&
                          a.error <= b.error + std::min(error_noise, kMaxTieNoise * b.error);
    const bool better = a.cost < b.cost - cost_noise || a.error < b.error - error_noise;
    return no_worse && better;
}

std::vector<bool> frontier(std::span<const Dot> dots) {
    std::vector<bool> on(dots.size());
    for (std::size_t i = 0; i < dots.size(); ++i)
        on[i] = finite(dots[i]) &&
                std::none_of(dots.begin(), dots.end(), [&](const Dot& d) { return dominates(d, dots[i]); });
    return on;
}

FrontierAdvice frontier_advice(const Dot& present, std::span<const Dot> dots, const std::vector<bool>& on_frontier) {
    FrontierAdvice advice;
    for (std::size_t i = 0; i < dots.size(); ++i) {
        const Dot& d = dots[i];
        if (!on_frontier[i] || !finite(d)) continue;
        const double cost_noise = std::max(d.cost_noise, present.cost_noise),
                     error_noise = std::max(d.error_noise, present.error_noise);
        if (d.error < present.error - error_noise && d.cost > present.cost + cost_noise &&
            (!advice.better || d.cost < dots[*advice.better].cost))
            advice.better = i;
        if (d.error <= present.error + error_noise && d.cost < present.cost - cost_noise &&
            (!advice.cheaper || d.cost < dots[*advice.cheaper].cost))
            advice.cheaper = i;
    }
    if (advice.better) advice.extra_cost = dots[*advice.better].cost - present.cost;
    if (advice.cheaper) advice.saved_cost = present.cost - dots[*advice.cheaper].cost;
    return advice;
}

}  // namespace si
