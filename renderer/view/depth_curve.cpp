#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/view/light_fit.h"
#include "renderer/view/projection.h"

namespace si {
namespace {

constexpr double kNearestShare = 1e-3;  // of the near plane, as in shaders/lib/receiver.glsl

}  // namespace

// A depth buffer holds the same values under both clip ranges ([-w,w] is halved and shifted by the viewport), so that
// zero_to_one enters the matrix only. Each formula is written so that it is exact at both ends of the range.

double DepthCurve::depth(double z) const {
    const double range = far - near;
    const double from_near = (z - near) / range, from_far = (far - z) / range;
    if (!perspective) return convention.reversed ? from_far : from_near;
    return convention.reversed ? near / z * from_far : far / z * from_near;
}

double DepthCurve::distance(double d) const {
    // As a sum of two shares, so that neither end cancels.
    const double from_near = convention.reversed ? 1 - d : d;
    const double from_far = 1 - from_near;
    if (!perspective) return near * from_far + far * from_near;
    return near * far / (far * from_far + near * from_near);
}

double DepthCurve::slope(double z) const {
    if (!perspective) return 1 / (far - near);
    return near / z * (far / z) / (far - near);
}

double DepthCurve::depth_nearer(double z, double metres) const {
    if (!perspective) return metres / (far - near);
    const double moved = std::min(metres, z - kNearestShare * near);
    return near / z * (far / (z - moved)) * (moved / (far - near));
}

double DepthCurve::metres_nearer(double z, double depth) const {
    if (!perspective) return depth * (far - near);
    if (std::isinf(depth)) return depth;
    const double by_slope = depth / slope(z);
    return by_slope > -z ? 1 / (1 / by_slope + 1 / z) : -std::numeric_limits<double>::infinity();
}

glm::dmat4 projection_matrix(const DepthCurve& curve, double half_x, double half_y) {
    const double n = curve.near, f = curve.far, range = f - n;
    const bool reversed = curve.convention.reversed;
    glm::dmat4 m(0.0);
    m[0][0] = 1 / half_x;
    m[1][1] = 1 / half_y;
    double a, b;  // clip z = a z_view + b, in [0,w]
    if (curve.perspective) {
        a = reversed ? n / range : -f / range;
        b = reversed ? f * (n / range) : -f * (n / range);
        m[2][3] = -1;
        if (!curve.convention.zero_to_one) a = 2 * a + 1, b = 2 * b;
    } else {
        a = reversed ? 1 / range : -1 / range;
        b = reversed ? f / range : -n / range;
        m[3][3] = 1;
        if (!curve.convention.zero_to_one) a = 2 * a, b = 2 * b - 1;
    }
    m[2][2] = a;
    m[3][2] = b;
    return m;
}

glm::dmat4 clip_from_relative(const glm::dmat4& projection, const glm::dmat3& axes, const glm::dvec3& eye,
                              const glm::dvec3& origin) {
    const glm::dmat3 rotation = glm::transpose(axes);
    glm::dmat4 view(rotation);
    view[3] = glm::dvec4(rotation * (origin - eye), 1.0);
    return projection * view;
}

glm::dmat4 LightView::clip_from_relative(const glm::dvec3& origin) const {
    return si::clip_from_relative(projection, axes, eye, origin);
}

glm::dvec3 LightView::position_ws(const glm::dvec2& uv, double z) const {
    const double half = half_width * (curve.perspective ? z : 1.0);
    return eye + axes * glm::dvec3((2.0 * uv - 1.0) * half, -z);
}

}  // namespace si
