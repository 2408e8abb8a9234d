#include "renderer/measure/front_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace si {
namespace {

bool is_finite(const Dot& d) {
    return std::isfinite(d.cost) && std::isfinite(d.error);
}

}  // namespace

std::vector<std::size_t> strict_front(std::span<const Dot> dots) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < dots.size(); ++i)
        if (is_finite(dots[i])) order.push_back(i);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        return dots[a].cost != dots[b].cost ? dots[a].cost < dots[b].cost : dots[a].error < dots[b].error;
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || dots[i].error < dots[front.back()].error) front.push_back(i);
    return front;
}

std::vector<FrontStep> front_steps(std::span<const Dot> dots, std::span<const std::size_t> front) {
    std::vector<FrontStep> steps;
    for (std::size_t i = 1; i < front.size(); ++i) {
        const Dot &from = dots[front[i - 1]], &to = dots[front[i]];
        steps.push_back({.from = front[i - 1],
                         .to = front[i],
                         .cost_factor = from.cost > 0 ? to.cost / from.cost : std::numeric_limits<double>::infinity(),
                         .error_reduction = 1 - to.error / from.error});
    }
    return steps;
}

bool is_clearly_better(const Dot& dot, const Dot& at) {
    return dot.error < at.error && dot.error <= (1 - kKneeReduction) * at.error;
}

std::optional<std::size_t> knee_of(std::span<const Dot> dots, std::span<const std::size_t> front) {
    for (const std::size_t i : front) {
        const Dot& at = dots[i];
        const bool dearer = std::ranges::any_of(dots, [&](const Dot& d) { return is_finite(d) && d.cost > at.cost; });
        const bool bought = std::ranges::any_of(dots, [&](const Dot& d) {
            return is_finite(d) && d.cost <= kKneeCost * at.cost && is_clearly_better(d, at);
        });
        if (dearer && !bought) return i;
    }
    return {};
}

std::optional<std::size_t> best_within(std::span<const Dot> dots, double limit) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < dots.size(); ++i) {
        const Dot& d = dots[i];
        if (!is_finite(d) || d.cost > limit) continue;
        if (!best || d.error < dots[*best].error || (d.error == dots[*best].error && d.cost < dots[*best].cost))
            best = i;
    }
    return best;
}

}  // namespace si
