#include "renderer/view/light_view.h"

#include <cmath>

#include "renderer/view/projection.h"

namespace si {
namespace {

/// Of map coordinates and a depth, in view space.
glm::dvec3 unprojected(const LightView& view, const glm::dvec2& uv, double depth) {
    const glm::dvec4 v =
        glm::inverse(uvd_from_clip(view.curve.convention) * view.projection) * glm::dvec4(uv, depth, 1.0);
    return glm::dvec3(v) / v.w;
}

}  // namespace

glm::dmat4 LightView::clip_from_relative(const glm::dvec3& origin) const {
    return si::clip_from_relative(projection, axes, eye, origin);
}

glm::dvec3 LightView::position_ws(const glm::dvec2& uv, double z) const {
    if (warped) return eye + axes * glm::dvec3(glm::dvec2(unprojected(*this, uv, 0.5)), -z);
    const double half = half_width * (curve.perspective ? z : 1.0);
    return eye + axes * glm::dvec3((2.0 * uv - 1.0) * half, -z);
}

double LightView::texel_size_at(const glm::dvec3& point_ws, int resolution) const {
    if (!warped) return texel_size(glm::dot(eye - point_ws, axes[2]), resolution);
    // How map coordinates change across the ray: rows of the matrix by the quotient rule.
    const glm::dmat4 m = uvd_from_clip(curve.convention) * clip_from_relative(point_ws);
    const double w = m[3][3];
    glm::dvec2 right, up;
    for (int i = 0; i < 2; ++i) {
        const auto row = [&](int r) { return glm::dvec3(m[0][r], m[1][r], m[2][r]); };
        const glm::dvec3 gradient = (row(i) - m[3][i] / w * row(3)) / w;
        right[i] = glm::dot(gradient, axes[0]), up[i] = glm::dot(gradient, axes[1]);
    }
    // The smaller singular value of that: the way along which a texel is longest.
    const double a = glm::dot(right, right), b = glm::dot(right, up), c = glm::dot(up, up);
    const double larger = std::sqrt(0.5 * (a + c + std::sqrt((a - c) * (a - c) + 4 * b * b)));
    const double determinant = std::abs(right.x * up.y - right.y * up.x);
    return larger / (determinant * resolution);
}

DepthCurve LightView::curve_at(const glm::dvec2& uv) const {
    DepthCurve at = curve;
    if (!warped) return at;
    at.near = -unprojected(*this, uv, curve.convention.near_depth()).z;
    at.far = -unprojected(*this, uv, curve.convention.far_depth()).z;
    return at;
}

}  // namespace si
