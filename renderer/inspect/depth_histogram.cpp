#include "renderer/inspect/depth_histogram.h"

#include <algorithm>
#include <cmath>

namespace si {
namespace {

bool is_drawn(float stored, const DepthCurve& curve) {
    return std::isfinite(stored) && double(stored) != curve.convention.far_depth();
}

}  // namespace

double shown_depth(double stored, const DepthCurve& curve, MapView view) {
    switch (view) {
        case MapView::Raw:
            return stored;
        case MapView::Linear:
            return (curve.distance(stored) - curve.near) / (curve.far - curve.near);
        case MapView::Bands:
            return curve.convention.reversed ? 1 - stored : stored;
    }
    return stored;
}

DepthStatistics depth_statistics(const FloatImage& depth, const DepthCurve& curve) {
    DepthStatistics s;
    float lo = 0, hi = 0;
    for (const float d : depth.data) {
        if (!is_drawn(d, curve)) {
            ++s.empty;
            continue;
        }
        lo = s.drawn ? std::min(lo, d) : d;
        hi = s.drawn ? std::max(hi, d) : d;
        ++s.drawn;
    }
    if (!s.drawn) return s;
    s.stored_min = lo, s.stored_max = hi;
    // Depth grows or falls with distance, never both.
    const auto both = [&](auto value, double& least, double& most) {
        least = value(double(lo)), most = value(double(hi));
        if (least > most) std::swap(least, most);
    };
    both([&](double d) { return shown_depth(d, curve, MapView::Linear); }, s.linear_min, s.linear_max);
    both([&](double d) { return curve.distance(d); }, s.metres_min, s.metres_max);
    return s;
}

DepthHistogram depth_histogram(const FloatImage& depth, const DepthCurve& curve, MapView view, int bins, double lo,
                               double hi) {
    DepthHistogram h{lo, hi, std::vector<std::uint64_t>(std::size_t(std::max(bins, 1))), 0, 0};
    const double scale = hi > lo ? double(h.counts.size()) / (hi - lo) : 0;
    for (const float d : depth.data) {
        if (!is_drawn(d, curve)) continue;
        const double value = shown_depth(d, curve, view);
        if (value < lo) {
            ++h.below;
        } else if (value > hi) {
            ++h.above;
        } else {
            ++h.counts[std::min(std::size_t((value - lo) * scale), h.counts.size() - 1)];
        }
    }
    return h;
}

}  // namespace si
