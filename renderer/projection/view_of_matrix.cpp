#include "renderer/projection/view_of_matrix.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/error.h"
#include "renderer/projection/projection.h"

namespace si {
namespace {

/// Largest relative change over the map that counts as rounding of the matrix, which engines compose in single
/// precision.
constexpr double kRounding = 1e-5;
/// Distance of near and far plane, far over near, from which single precision no longer tells the far plane from one
/// at infinity.
constexpr double kEndless = 1e6;
/// Far plane of a depth range without end, as a multiple of the near plane. At a thousand times the near plane, depths
/// of this range differ from those of the endless one by a hundred-thousandth of themselves.
constexpr double kEndlessFar = 1e8;

/// Returns clip-space z / w of the near or far plane.
double plane_ndc(const DepthConvention& convention, bool far) {
    const double depth = far ? convention.far_depth() : convention.near_depth();
    return convention.zero_to_one ? depth : 2 * depth - 1;
}

bool is_finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

glm::dvec3 linear_row(const glm::dmat4& m, int row) {
    return {m[0][row], m[1][row], m[2][row]};
}

/// Returns the matrix from the view's axes to clip space.
glm::dmat4 clip_from_view(const glm::dmat4& clip_from_world, const LightView& view) {
    glm::dmat4 world_from_view(view.axes);
    world_from_view[3] = glm::dvec4(view.eye, 1);
    return clip_from_world * world_from_view;
}

/// Sets axes from the viewing direction and the direction in the world in which map coordinate u grows.
void set_axes(LightView& view, const glm::dvec3& back, const glm::dvec3& u) {
    const glm::dvec3 right = glm::normalize(u - glm::dot(u, back) * back);
    view.axes = {right, glm::cross(back, right), back};
}

void check_order(const DepthCurve& curve) {
    if (!(curve.far > curve.near))
        throw Error(
            "the matrix: depth grows against its convention, near lies behind far; the other reversed setting fits");
}

void fill_perspective(LightView& view, glm::dmat4 m) {
    const double scale = glm::length(linear_row(m, 3));
    m /= scale;
    const glm::dvec3 back = -linear_row(m, 3);
    // The eye is where x, y and w are 0.
    const glm::dmat3 rows = glm::transpose(glm::dmat3(linear_row(m, 0), linear_row(m, 1), linear_row(m, 3)));
    view.eye = glm::inverse(rows) * -glm::dvec3(m[3][0], m[3][1], m[3][3]);
    set_axes(view, back, linear_row(m, 0));
    glm::dmat4 p = clip_from_view(m, view);
    // Depth changes across the axis by this share of its change along it.
    if (std::hypot(p[0][2], p[1][2]) > kRounding * std::abs(p[2][2]) + kRounding * std::hypot(p[0][0], p[1][1]))
        throw Error("the matrix: its near plane is oblique; a plane across the view's axis is needed");
    p[0][2] = p[1][2] = 0;
    p[0][3] = p[1][3] = p[3][3] = 0;
    p[3][0] = p[3][1] = 0;
    p[1][0] = 0;
    if (std::abs(p[0][1]) > kRounding * std::abs(p[1][1]))
        throw Error("the matrix: its frustum is skewed; rows of the map at right angles to its columns are needed");
    p[0][1] = 0;
    if (std::abs(std::abs(p[0][0]) - std::abs(p[1][1])) < kRounding * std::abs(p[0][0]))
        p[1][1] = std::copysign(p[0][0], p[1][1]);
    p[2][3] = -1;
    view.projection = p;
    DepthCurve& curve = view.curve;
    curve.perspective = true;
    curve.near = p[3][2] / (plane_ndc(curve.convention, false) + p[2][2]);
    const double to_far = plane_ndc(curve.convention, true) + p[2][2];
    const bool is_endless = std::abs(to_far) * kEndless * curve.near < std::abs(p[3][2]);
    curve.far = is_endless ? kEndlessFar * curve.near : p[3][2] / to_far;
    check_order(curve);
}

/// @param near,far world-space points on the ray through the map's middle
void fill_parallel(LightView& view, glm::dmat4 m, const glm::dvec3& near, const glm::dvec3& far) {
    const glm::dvec3 back = glm::normalize(near - far);
    view.eye = near + (near - far);
    m /= (m * glm::dvec4(view.eye, 1)).w;
    const double u_at_eye = (m * glm::dvec4(view.eye, 1)).x;
    set_axes(view, back, linear_row(m, 0) - u_at_eye * linear_row(m, 3));
    glm::dmat4 p = clip_from_view(m, view);
    p[2][0] = p[2][1] = p[2][3] = 0;  // parallel rays
    p[3][3] = 1;
    const double metres = 1 / std::max(std::abs(p[0][0]), std::abs(p[1][1]));  // half of the map's smaller side
    for (int axis = 0; axis < 2; ++axis)
        if (std::abs(p[axis][3]) * metres < kRounding) p[axis][3] = 0;
    for (const auto& [column, row] : {std::pair(1, 0), std::pair(0, 1)})
        if (std::abs(p[column][row]) * metres < kRounding) p[column][row] = 0;
    view.projection = p;

    // With n = (x, y, 1) in clip space, a place across the rays is H^-1 n, and w is 1 over the last coordinate of it.
    const glm::dmat3 clip_from_across({p[0][0], p[0][1], p[0][3]}, {p[1][0], p[1][1], p[1][3]},
                                      {p[3][0], p[3][1], p[3][3]});
    const glm::dmat3 across = glm::inverse(clip_from_across);
    // Affine functions of n: 1 / w, and clip z without its part along the axis, over w.
    const glm::dvec3 inverse_w(across[0].z, across[1].z, across[2].z);
    const glm::dvec3 aside = glm::transpose(across) * glm::dvec3(p[0][2], p[1][2], p[3][2]);
    // Both as functions of v: columns may not count.
    const double slope_w = 2 * inverse_w.y, slope_aside = 2 * aside.y;
    const double w0 = inverse_w.z - inverse_w.x - inverse_w.y, aside0 = aside.z - aside.x - aside.y;
    const double along = p[2][2];
    if (!(w0 > 0) || !(w0 + slope_w > 0)) throw Error("the matrix: w is not above 0 in the whole map");
    if (2 * std::abs(inverse_w.x) > kRounding * w0)
        throw Error(
            "the matrix: w changes from column to column; turn the map by 90 degrees, so that it changes by row");
    const bool changes_w = std::abs(slope_w) > kRounding * w0;
    const double middle = changes_w ? slope_aside / (along * slope_w) : 0;
    const auto plane_m = [&](bool is_far) {
        return (aside0 - plane_ndc(view.curve.convention, is_far)) / (along * w0) - middle;
    };
    DepthWarp warp{middle, plane_m(false), plane_m(true), changes_w ? slope_w / w0 : 0};
    const double range = std::abs(warp.far_m - warp.near_m);
    const double tilt = changes_w ? 0 : slope_aside / (along * w0);
    if (std::abs(2 * aside.x / (along * w0)) > kRounding * range || std::abs(tilt) > kRounding * range)
        throw Error("the matrix: its near plane is oblique; a plane across the light's rays is needed");
    DepthCurve& curve = view.curve;
    curve.perspective = false;
    const bool is_square =
        p[1][0] == 0 && p[0][1] == 0 && std::abs(std::abs(p[0][0]) - std::abs(p[1][1])) < kRounding * std::abs(p[0][0]);
    if (changes_w || !is_square) curve.warp = warp;
    curve.near = middle + warp.near_m;
    curve.far = middle + warp.far_m;
    if (changes_w) {
        const DepthCurve last = curve.curve_at_row(1);
        curve.near = std::min(curve.near, last.near);
        curve.far = std::max(curve.far, last.far);
    }
    check_order(curve);
}

}  // namespace

LightView view_of_matrix(const glm::dmat4& clip_from_world, const DepthConvention& convention) {
    if (!is_finite(clip_from_world)) throw Error("the matrix: a number is not finite");
    const glm::dmat4 world_from_clip = glm::inverse(clip_from_world);
    if (!is_finite(world_from_clip)) throw Error("the matrix: it is singular; view and projection are needed");
    const auto at = [&](double x, double y, bool far) {
        return world_from_clip * glm::dvec4(x, y, plane_ndc(convention, far), 1);
    };
    bool is_parallel = true;
    double greatest = 0;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0}) greatest = std::max(greatest, std::abs(at(x, y, false).w));
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0}) {
            const double near = at(x, y, false).w, far = at(x, y, true).w;  // 1 / w
            if (!(near > 0) || !(far > -greatest / kEndless))
                throw Error("the matrix: a corner of its depth range lies behind the light; w must be above 0 there");
            if (std::abs(near - far) > kRounding * std::max(near, far)) is_parallel = false;
        }
    LightView view;
    view.curve.convention = convention;
    const glm::dvec4 near = at(0, 0, false), far = at(0, 0, true);
    if (is_parallel)
        fill_parallel(view, clip_from_world, glm::dvec3(near) / near.w, glm::dvec3(far) / far.w);
    else
        fill_perspective(view, clip_from_world);
    return view;
}

bool is_mirrored(const LightView& view) {
    const glm::dmat4& p = view.projection;
    // Places across the axis: one metre along it in perspective, anywhere along it for parallel rays.
    const glm::dvec4 from_axis = view.curve.perspective ? -p[2] : p[3];
    const glm::dmat3 clip_from_across({p[0][0], p[0][1], p[0][3]}, {p[1][0], p[1][1], p[1][3]},
                                      {from_axis.x, from_axis.y, from_axis.w});
    return glm::determinant(view.axes) * glm::determinant(clip_from_across) < 0;
}

bool is_warped_by_column(const glm::dmat4& clip_from_world) {
    const glm::dmat4 world_from_clip = glm::inverse(clip_from_world);
    // 1 / w is an affine function of the place in clip space.
    const auto change = [&](int axis) { return std::abs(world_from_clip[axis][3]); };
    const double least = kRounding * std::abs(world_from_clip[3][3]);
    return is_finite(world_from_clip) && change(0) > least && change(1) <= least && change(2) <= least;
}

}  // namespace si
