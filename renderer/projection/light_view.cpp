#include "renderer/projection/light_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/projection/projection.h"

namespace si {
namespace {

/// Returns the map coordinates of a point in a parallel view.
glm::dvec2 coordinates(const LightView& view, const glm::dvec3& point_ws) {
    const glm::dvec4 h = view.clip_from_relative(point_ws)[3];
    return 0.5 * glm::dvec2(h) / h.w + 0.5;
}

/// Returns the view-space position across the axis of map coordinates.
glm::dvec2 across(const LightView& view, const glm::dvec2& uv) {
    // Rays are parallel to the axis, so depth does not matter.
    const glm::dmat4& m = view.projection;
    const glm::dmat3 clip_from_across({m[0][0], m[0][1], m[0][3]}, {m[1][0], m[1][1], m[1][3]},
                                      {m[3][0], m[3][1], m[3][3]});
    const glm::dvec3 v = glm::inverse(clip_from_across) * glm::dvec3(2.0 * uv - 1.0, 1);
    return glm::dvec2(v) / v.z;
}

}  // namespace

glm::dmat4 LightView::clip_from_relative(const glm::dvec3& origin) const {
    return si::clip_from_relative(projection, axes, eye, origin);
}

glm::dvec3 LightView::position_ws(const glm::dvec2& uv, double z) const {
    if (warped()) return eye + axes * glm::dvec3(across(*this, uv), -z);
    const double half = half_width * (curve.perspective ? z : 1.0);
    return eye + axes * glm::dvec3((2.0 * uv - 1.0) * half, -z);
}

TexelSize LightView::texel_size_at(const glm::dvec3& point_ws, int resolution) const {
    if (!warped()) {
        const double size = texel_size(glm::dot(eye - point_ws, axes[2]), resolution);
        return {size, size};
    }
    // Derivatives of map coordinates across the rays, by the quotient rule.
    const glm::dmat4 m = uvd_from_clip(curve.convention) * clip_from_relative(point_ws);
    const double w = m[3][3];
    glm::dvec2 right, up;
    for (int i = 0; i < 2; ++i) {
        const auto row = [&](int r) { return glm::dvec3(m[0][r], m[1][r], m[2][r]); };
        const glm::dvec3 gradient = (row(i) - m[3][i] / w * row(3)) / w;
        right[i] = glm::dot(gradient, axes[0]);
        up[i] = glm::dot(gradient, axes[1]);
    }
    // Singular values of the derivative. The smaller one comes from the determinant, which keeps digits that a
    // difference of squares loses.
    const double a = glm::dot(right, right), b = glm::dot(right, up), c = glm::dot(up, up);
    const double larger = std::sqrt(0.5 * (a + c + std::sqrt((a - c) * (a - c) + 4 * b * b)));
    const double determinant = std::abs(right.x * up.y - right.y * up.x);
    return {larger / (determinant * resolution), 1 / (larger * resolution)};
}

TexelSize LightView::texel_size_range(int resolution) const {
    if (!warped()) {
        const double a = texel_size(curve.near, resolution), b = texel_size(curve.far, resolution);
        return {std::max(a, b), std::min(a, b)};
    }
    // Both singular values grow with w and with the shear, which is largest in the corners.
    TexelSize all{0, std::numeric_limits<double>::infinity()};
    for (const double u : {0.0, 0.5, 1.0})
        for (const double v : {0.0, 0.5, 1.0}) {
            const TexelSize one = texel_size_at(position_ws({u, v}, curve.near), resolution);
            all = {std::max(all.longest, one.longest), std::min(all.shortest, one.shortest)};
        }
    return all;
}

DepthCurve LightView::ray_depth_curve(const glm::dvec3& point_ws) const {
    return warped() ? curve.curve_at_row(coordinates(*this, point_ws).y) : curve;
}

double LightView::relative_dw_per_m(const glm::dvec3& point_ws) const {
    if (!warped()) return 0;
    return std::abs(projection[1][3]) / std::abs(clip_from_relative(point_ws)[3][3]);
}

}  // namespace si
