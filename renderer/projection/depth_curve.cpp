#include "renderer/projection/depth_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace si {
namespace {

constexpr double kNearestShare = 1e-3;  // share of the near plane, as in shaders/lib/receiver.glsl

}  // namespace

// A depth buffer stores the same values under both clip ranges, since the viewport halves and shifts [-w,w]. So
// zero_to_one enters the matrix only. Each formula is exact at both ends of the range.

DepthCurve DepthCurve::curve_at_row(double v) const {
    if (!warp) return *this;
    DepthCurve row = *this;
    row.warp.reset();
    const double scale = 1 / (1 + warp->rise * std::clamp(v, 0.0, 1.0));
    row.near = warp->middle_m + warp->near_m * scale;
    row.far = warp->middle_m + warp->far_m * scale;
    return row;
}

double DepthCurve::depth(double z) const {
    const double range = far - near;
    const double from_near = (z - near) / range, from_far = (far - z) / range;
    if (!perspective) return convention.reversed ? from_far : from_near;
    return convention.reversed ? near / z * from_far : far / z * from_near;
}

double DepthCurve::distance(double d) const {
    // A sum of two shares, so that neither end cancels.
    const double from_near = convention.reversed ? 1 - d : d;
    const double from_far = 1 - from_near;
    if (!perspective) return near * from_far + far * from_near;
    return near * far / (far * from_far + near * from_near);
}

double DepthCurve::depth_at_fraction(double share) const {
    if (!perspective || !(share > 0 && share < 1)) return share;
    const double z = convention.reversed ? far - share * (far - near) : near + share * (far - near);
    return (convention.reversed ? near : far) * share / z;
}

double DepthCurve::slope(double z) const {
    if (!perspective) return 1 / (far - near);
    return near / z * (far / z) / (far - near);
}

double DepthCurve::depth_change_towards_light(double z, double metres) const {
    if (!perspective) return metres / (far - near);
    const double moved = std::min(metres, z - kNearestShare * near);
    return near / z * (far / (z - moved)) * (moved / (far - near));
}

double DepthCurve::metres_towards_light(double z, double depth) const {
    if (!perspective) return depth * (far - near);
    if (std::isinf(depth)) return depth;
    const double by_slope = depth / slope(z);
    return by_slope > -z ? 1 / (1 / by_slope + 1 / z) : -std::numeric_limits<double>::infinity();
}

}  // namespace si
