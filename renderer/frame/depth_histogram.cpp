#include "renderer/frame/depth_histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace si {
namespace {

bool is_drawn(float stored, const DepthCurve& curve) {
    return std::isfinite(stored) && double(stored) != curve.convention.far_depth();
}

}  // namespace

double map_v_of_row(const FloatImage& depth, int y) {
    return (depth.height - y - 0.5) / depth.height;
}

double shown_depth(double stored, const DepthCurve& curve, MapView view, double row) {
    if (view == MapView::Linear)
        return (curve.curve_at_row(row).distance(stored) - curve.near) / (curve.far - curve.near);
    return view == MapView::Bands && curve.convention.reversed ? 1 - stored : stored;
}

DepthStatistics depth_statistics(const FloatImage& depth, const DepthCurve& curve) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    DepthStatistics s{.stored_min = kNone, .stored_max = -kNone, .metres_min = kNone, .metres_max = -kNone};
    for (int y = 0; y < depth.height; ++y) {
        double lo = kNone, hi = -kNone;
        for (int x = 0; x < depth.width; ++x) {
            const float d = depth.at(x, y);
            if (!is_drawn(d, curve)) {
                ++s.empty;
                continue;
            }
            lo = std::min(lo, double(d));
            hi = std::max(hi, double(d));
            ++s.drawn;
        }
        if (!(lo <= hi)) continue;
        s.stored_min = std::min(s.stored_min, lo);
        s.stored_max = std::max(s.stored_max, hi);
        // Depth grows or falls with distance, never both.
        const DepthCurve row = curve.curve_at_row(map_v_of_row(depth, y));
        const double a = row.distance(lo), b = row.distance(hi);
        s.metres_min = std::min({s.metres_min, a, b});
        s.metres_max = std::max({s.metres_max, a, b});
    }
    if (!s.drawn) return {.empty = s.empty};
    s.linear_min = (s.metres_min - curve.near) / (curve.far - curve.near);
    s.linear_max = (s.metres_max - curve.near) / (curve.far - curve.near);
    return s;
}

DepthHistogram depth_histogram(const FloatImage& depth, const DepthCurve& curve, MapView view, int bins, double lo,
                               double hi) {
    DepthHistogram h{lo, hi, std::vector<std::uint64_t>(std::size_t(std::max(bins, 1))), 0, 0};
    const double scale = hi > lo ? double(h.counts.size()) / (hi - lo) : 0;
    for (std::size_t i = 0; i < depth.data.size(); ++i) {
        const float d = depth.data[i];
        if (!is_drawn(d, curve)) continue;
        const double value = shown_depth(d, curve, view, map_v_of_row(depth, int(i / std::size_t(depth.width))));
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
