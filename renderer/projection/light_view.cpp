#include "renderer/projection/light_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/projection/projection.h"

namespace si {
namespace {

/// Returns the map coordinates of a point in a parallel view.
glm::dvec2 coordinates(const LightView& view, const glm::dvec3& point_ws) {
    const glm::dvec4 h = view.clip_position(point_ws);
    return 0.5 * glm::dvec2(h) / h.w + 0.5;
}

/// Returns true when x and y of the map depend on one axis each and w depends on no axis across the rays.
bool is_axis_aligned(const glm::dmat4& m) {
    return m[0][1] == 0 && m[1][0] == 0 && m[0][3] == 0 && m[1][3] == 0;
}

/// Returns the view-space position across the axis of map coordinates: metres, or in perspective tangents.
glm::dvec2 across(const LightView& view, const glm::dvec2& uv) {
    const glm::dmat4& m = view.projection;
    const glm::dvec2 ndc = 2.0 * uv - 1.0;
    // One metre along the axis in perspective. Parallel rays have one place at all distances.
    const glm::dvec4 from_axis = view.curve.perspective ? -m[2] : m[3];
    if (is_axis_aligned(m)) return (ndc - glm::dvec2(from_axis)) / glm::dvec2(m[0][0], m[1][1]);
    const glm::dmat3 clip_from_across({m[0][0], m[0][1], m[0][3]}, {m[1][0], m[1][1], m[1][3]},
                                      {from_axis.x, from_axis.y, from_axis.w});
    const glm::dvec3 v = glm::inverse(clip_from_across) * glm::dvec3(ndc, 1);
    return glm::dvec2(v) / v.z;
}

/// Returns the sizes of a texel from the change of its map's texels per metre to the right and up.
TexelSize size_by_derivatives(const glm::dvec2& right, const glm::dvec2& up) {
    // Singular values of the derivative. The smaller one comes from the determinant, which keeps digits that a
    // difference of squares loses.
    const double a = glm::dot(right, right), b = glm::dot(right, up), c = glm::dot(up, up);
    const double larger = std::sqrt(0.5 * (a + c + std::sqrt((a - c) * (a - c) + 4 * b * b)));
    const double determinant = std::abs(right.x * up.y - right.y * up.x);
    return {larger / determinant, 1 / larger};
}

}  // namespace

void LightView::set_half_extents(const glm::dvec2& half) {
    projection = projection_matrix(curve, half.x, half.y);
}

void LightView::update_depth() {
    const glm::dvec2 scale(projection[0][0], projection[1][1]);
    projection = projection_matrix(curve, 1, 1);
    projection[0][0] = scale.x;
    projection[1][1] = scale.y;
}

glm::dmat4 LightView::clip_from_relative(const glm::dvec3& origin) const {
    return si::clip_from_relative(projection, axes, eye, origin);
}

glm::dvec4 LightView::clip_position(const glm::dvec3& point_ws) const {
    const glm::dvec3 p = glm::transpose(axes) * (point_ws - eye);
    // In the order of a product of matrices, so that both round alike.
    return projection[0] * p.x + projection[1] * p.y + projection[2] * p.z + projection[3];
}

CrossSection LightView::cross_section() const {
    const glm::dvec2 first = across(*this, {0, 0});
    CrossSection around{first, first};
    for (const glm::dvec2 uv : {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
        const glm::dvec2 at = across(*this, uv);
        around.lo = glm::min(around.lo, at);
        around.hi = glm::max(around.hi, at);
    }
    return around;
}

glm::dvec2 LightView::half_extents() const {
    const CrossSection around = cross_section();
    return glm::max(-around.lo, around.hi);
}

double LightView::half_extent() const {
    const glm::dvec2 half = half_extents();
    return std::max(half.x, half.y);
}

glm::dvec3 LightView::position_ws(const glm::dvec2& uv, double z) const {
    return eye + axes * glm::dvec3(across(*this, uv) * (curve.perspective ? z : 1.0), -z);
}

bool LightView::stretched(MapSize size) const {
    if (warped()) return false;
    const TexelSize texel = texel_sizes(1, size);
    return texel.longest > texel.shortest * (1 + 1e-9);
}

TexelSize LightView::texel_sizes(double z, MapSize size) const {
    const glm::dmat4& m = projection;
    const double widening = curve.perspective ? z : 1.0;
    if (is_axis_aligned(m)) {
        const double width = 2 / std::abs(m[0][0]) * widening / size.width;
        const double height = 2 / std::abs(m[1][1]) * widening / size.height;
        return {std::max(width, height), std::min(width, height)};
    }
    const glm::dvec2 texels = 0.5 * glm::dvec2(size.width, size.height) / widening;
    return size_by_derivatives(texels * glm::dvec2(m[0]), texels * glm::dvec2(m[1]));
}

TexelSize LightView::texel_size_at(const glm::dvec3& point_ws, MapSize size) const {
    if (!warped()) return texel_sizes(glm::dot(eye - point_ws, axes[2]), size);
    // Derivatives of map coordinates across the rays, by the quotient rule.
    const glm::dmat4 m = uvd_from_clip(curve.convention) * clip_from_relative(point_ws);
    const double w = m[3][3];
    const glm::dvec2 texels(size.width, size.height);
    glm::dvec2 right, up;
    for (int i = 0; i < 2; ++i) {
        const auto row = [&](int r) { return glm::dvec3(m[0][r], m[1][r], m[2][r]); };
        const glm::dvec3 gradient = (row(i) - m[3][i] / w * row(3)) / w;
        right[i] = texels[i] * glm::dot(gradient, axes[0]);
        up[i] = texels[i] * glm::dot(gradient, axes[1]);
    }
    return size_by_derivatives(right, up);
}

TexelSize LightView::texel_size_range(MapSize size) const {
    if (!warped()) {
        const TexelSize a = texel_sizes(curve.near, size), b = texel_sizes(curve.far, size);
        return {std::max(a.longest, b.longest), std::min(a.shortest, b.shortest)};
    }
    // Both singular values grow with w and with the shear, which is largest in the corners.
    TexelSize all{0, std::numeric_limits<double>::infinity()};
    for (const double u : {0.0, 0.5, 1.0})
        for (const double v : {0.0, 0.5, 1.0}) {
            const TexelSize one = texel_size_at(position_ws({u, v}, curve.near), size);
            all = {std::max(all.longest, one.longest), std::min(all.shortest, one.shortest)};
        }
    return all;
}

DepthCurve LightView::ray_depth_curve(const glm::dvec3& point_ws) const {
    return warped() ? curve.curve_at_row(coordinates(*this, point_ws).y) : curve;
}

double LightView::relative_dw_per_m(const glm::dvec3& point_ws) const {
    if (!warped()) return 0;
    return std::hypot(projection[0][3], projection[1][3]) / std::abs(clip_position(point_ws).w);
}

}  // namespace si
