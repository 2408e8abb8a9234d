#include "renderer/projection/camera_of_matrix.h"

#include <cmath>

#include "renderer/base/error.h"

namespace si {
namespace {

constexpr double kParallel = 1e-7;  ///< largest share of w in x that counts as rounding
constexpr double kOffAxis = 1e-4;   ///< largest shift of the middle, as a share of the picture, that counts as rounding

glm::dvec3 row_of(const glm::dmat4& m, int row) {
    return {m[0][row], m[1][row], m[2][row]};
}

bool is_usable(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Returns clip-space z / w of the near or far plane.
double plane_z(const DepthConvention& convention, bool far) {
    const double depth = far ? convention.far_depth() : convention.near_depth();
    return convention.zero_to_one ? depth : 2 * depth - 1;
}

}  // namespace

double MatrixCamera::fov_y_rad() const {
    return 2 * std::atan(0.5 * (hi.y - lo.y));
}

bool MatrixCamera::is_off_axis() const {
    const glm::dvec2 middle = glm::abs(lo + hi), size = hi - lo;
    return middle.x > kOffAxis * size.x || middle.y > kOffAxis * size.y;
}

MatrixCamera camera_of_matrix(const glm::dmat4& clip_from_world, const DepthConvention& convention) {
    const auto refuse = [](bool wrong, const char* why) {
        if (wrong) throw Error(std::string("the matrix: ") + why);
    };
    glm::dmat4 m = clip_from_world;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            refuse(!std::isfinite(m[c][r]), "a number is not finite; view and projection are needed");
    MatrixCamera out;
    out.orthographic = glm::length(row_of(m, 3)) <= kParallel * glm::length(row_of(m, 0));
    const double scale = out.orthographic ? m[3][3] : glm::length(row_of(m, 3));
    refuse(!(scale > 0), "w is not above 0; view and projection are needed");
    m /= scale;
    glm::dvec3 right = row_of(m, 0), up = row_of(m, 1), forward;
    if (out.orthographic) {
        forward = glm::cross(right, up);
        // Depth grows along the view, or falls for reversed depth.
        const double depth_along = glm::dot(forward, row_of(m, 2)) * (convention.reversed ? -1 : 1);
        if (depth_along < 0) forward = -forward;
    } else {
        forward = row_of(m, 3);
    }
    forward = glm::normalize(forward);
    right = glm::normalize(right - glm::dot(right, forward) * forward);
    refuse(!is_usable(forward) || !is_usable(right), "it is singular; view and projection are needed");
    out.axes = {right, glm::cross(-forward, right), -forward};
    const glm::dvec2 rates(glm::dot(right, row_of(m, 0)), glm::dot(out.axes[1], up));
    refuse(!(rates.x > 0) || rates.y == 0, "it is singular; view and projection are needed");
    glm::dvec2 middle;  // clip x and y of the axis
    if (out.orthographic) {
        const double z = glm::dot(forward, row_of(m, 2));
        refuse(z == 0, "it has no depth; view and projection are needed");
        const double at_near = (plane_z(convention, false) - m[3][2]) / z;
        const double at_far = (plane_z(convention, true) - m[3][2]) / z;
        // The eye lies in the picture's middle on the near plane.
        out.eye = at_near * forward - m[3][0] / rates.x * right - m[3][1] / rates.y * out.axes[1];
        middle = {0, 0};
        out.far = at_far - at_near;
        refuse(!(out.far > 0), "depth grows against its convention; the other reversed setting fits");
    } else {
        const glm::dmat3 rows = glm::transpose(glm::dmat3(row_of(m, 0), up, row_of(m, 3)));
        out.eye = glm::inverse(rows) * -glm::dvec3(m[3][0], m[3][1], m[3][3]);
        middle = {glm::dot(forward, row_of(m, 0)), glm::dot(forward, up)};
        // Clip z at d metres is a d + b, and w is d.
        const double a = glm::dot(forward, row_of(m, 2)), b = glm::dot(out.eye, row_of(m, 2)) + m[3][2];
        const auto distance = [&](bool far) {
            const double d = b / (plane_z(convention, far) - a);
            return std::isfinite(d) && d > 0 ? d : 0;
        };
        out.near = distance(false);
        out.far = distance(true);
        if (out.far <= out.near) out.far = 0;
    }
    refuse(!is_usable(out.eye), "it is singular; view and projection are needed");
    const glm::dvec2 first = (glm::dvec2(-1) - middle) / rates, last = (glm::dvec2(1) - middle) / rates;
    out.lo = glm::min(first, last);
    out.hi = glm::max(first, last);
    return out;
}

}  // namespace si
