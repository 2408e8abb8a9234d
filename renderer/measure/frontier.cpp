#include "renderer/measure/frontier.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace si {
namespace {

/// Linear interpolation between the two nearest ranks.
double quantile(const std::vector<double>& sorted, double q) {
    const double at = q * double(sorted.size() - 1);
    const auto below = std::size_t(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - double(below)) * (sorted[above] - sorted[below]);
}

bool finite(const Dot& d) {
    return std::isfinite(d.cost) && std::isfinite(d.error);
}

}  // namespace

double Spread::relative() const {
    if (samples < 2 || median <= 0) return 1;
    return 0.5 * (median_high - median_low) / median;
}

Spread spread_of(std::vector<double> samples) {
    Spread s;
    s.samples = int(samples.size());
    if (samples.empty()) return s;
    std::sort(samples.begin(), samples.end());
    s.low = samples.front(), s.high = samples.back();
    s.median = quantile(samples, 0.5);
    s.p95 = quantile(samples, 0.95);
    const double below = std::floor(0.5 * s.samples - 0.98 * std::sqrt(double(s.samples)));
    const auto rank = std::size_t(std::max(below, 0.0));
    s.median_low = samples[rank], s.median_high = samples[samples.size() - 1 - rank];
    return s;
}

bool dominates(const Dot& a, const Dot& b) {
    if (!finite(a) || !finite(b)) return false;
    const double cost_noise = std::max(a.cost_noise, b.cost_noise), error_noise = std::max(a.error_noise, b.error_noise);
    const bool no_worse = a.cost <= b.cost + cost_noise && a.error <= b.error + error_noise;
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

Advice advise(const Dot& present, std::span<const Dot> dots, const std::vector<bool>& on_frontier) {
    Advice advice;
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

std::optional<double> log_slope(std::span<const double> x, std::span<const double> error) {
    std::vector<double> u, v;
    for (std::size_t i = 0; i < std::min(x.size(), error.size()); ++i)
        if (x[i] > 0 && error[i] > 0 && std::isfinite(x[i]) && std::isfinite(error[i]))
            u.push_back(std::log(x[i])), v.push_back(std::log(error[i]));
    if (u.size() < 2) return {};
    const double n = double(u.size());
    const double mu = std::accumulate(u.begin(), u.end(), 0.0) / n, mv = std::accumulate(v.begin(), v.end(), 0.0) / n;
    double uu = 0, uv = 0;
    for (std::size_t i = 0; i < u.size(); ++i) uu += (u[i] - mu) * (u[i] - mu), uv += (u[i] - mu) * (v[i] - mv);
    if (uu <= 0) return {};
    return uv / uu;
}

}  // namespace si
