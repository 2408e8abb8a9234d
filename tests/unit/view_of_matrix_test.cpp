// Light views of any matrix and size: texels, depth ranges and slopes against closed forms and finite differences.
#include "renderer/projection/view_of_matrix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "renderer/base/error.h"
#include "renderer/projection/projection.h"

namespace si {
namespace {

const glm::dvec3 kEye{3, 7, -2};

/// Makes axes of a light that looks along no axis of the world.
glm::dmat3 tilted_axes() {
    const glm::dvec3 back = glm::normalize(glm::dvec3(1, 3, 2));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.2, 1, 0), back));
    return {right, glm::cross(back, right), back};
}

/// Returns the matrix of a projection seen from kEye.
glm::dmat4 from_world(const glm::dmat4& projection) {
    return clip_from_relative(projection, tilted_axes(), kEye, glm::dvec3(0));
}

/// Returns a projection whose sides lie at `lo` and `hi`: metres, or in perspective tangents.
glm::dmat4 off_centre(const DepthCurve& curve, const glm::dvec2& lo, const glm::dvec2& hi) {
    glm::dmat4 m = projection_matrix(curve, 0.5 * (hi.x - lo.x), 0.5 * (hi.y - lo.y));
    const glm::dvec2 middle = (hi + lo) / (hi - lo);
    for (int i = 0; i < 2; ++i) m[curve.perspective ? 2 : 3][i] = curve.perspective ? middle[i] : -middle[i];
    return m;
}

/// Returns a LiSPSM-like projection: parallel rays, w = 1 + 0.05 y, and depth (z - 4) / w from 1 m to 9 m.
glm::dmat4 warped_projection(bool reversed) {
    glm::dmat4 m(0.0);
    m[0][0] = 0.25;
    m[1][1] = 0.2;
    m[1][3] = 0.05;
    m[3][3] = 1;
    const double a = (reversed ? -1.0 : 1.0) / 8, b = reversed ? 9.0 / 8 : -1.0 / 8;
    m[2][2] = -a;
    m[1][2] = b * 0.05;
    m[3][2] = b - a * 4;
    return m;
}

/// Returns a perspective projection whose far plane lies at infinity.
/// @param near distance of the near plane, metres
glm::dmat4 endless_projection(double near, const DepthConvention& convention) {
    glm::dmat4 m = projection_matrix({true, near, 2 * near, convention, {}}, 0.5, 0.8);
    const double near_ndc =
        uvd_from_clip(convention)[2][2] == 1 ? convention.near_depth() : 2 * convention.near_depth() - 1;
    const double far_ndc =
        uvd_from_clip(convention)[2][2] == 1 ? convention.far_depth() : 2 * convention.far_depth() - 1;
    m[2][2] = -far_ndc;
    m[3][2] = (near_ndc - far_ndc) * near;
    return m;
}

/// Returns map coordinates and depth of a world-space point by a matrix alone.
glm::dvec3 uvd_of(const glm::dmat4& clip_from_world, const DepthConvention& convention, const glm::dvec3& p) {
    const glm::dvec4 h = clip_from_world * glm::dvec4(p, 1);
    return uvd_from_ndc(convention, glm::dvec3(h) / h.w);
}

/// Rounds a matrix to single precision, as an engine's uniform is.
glm::dmat4 in_floats(const glm::dmat4& m) {
    return glm::dmat4(glm::mat4(m));
}

/// Compares places, depths, depth per metre and texel sizes of a view with those of the matrix, over the whole map.
void expect_as_matrix(const LightView& view, const glm::dmat4& m, MapSize size, double tolerance) {
    const DepthConvention& convention = view.curve.convention;
    for (const double u : {0.05, 0.5, 0.9})
        for (const double v : {0.0, 0.4, 1.0})
            for (const double share : {0.1, 0.7}) {
                const DepthCurve row = view.curve.curve_at_row(v);
                const double z = row.near + share * (row.far - row.near);
                const glm::dvec3 p = view.position_ws({u, v}, z);
                const glm::dvec3 uvd = uvd_of(m, convention, p);
                EXPECT_NEAR(uvd.x, u, tolerance);
                EXPECT_NEAR(uvd.y, v, tolerance);
                EXPECT_NEAR(uvd.z, view.ray_depth_curve(p).depth(z), tolerance);
                // Depth per metre along the ray.
                const double step = 1e-4 * z;
                const glm::dvec3 nearer = view.position_ws({u, v}, z - step),
                                 farther = view.position_ws({u, v}, z + step);
                const double slope =
                    std::abs(uvd_of(m, convention, farther).z - uvd_of(m, convention, nearer).z) / (2 * step);
                EXPECT_NEAR(view.ray_depth_curve(p).slope(z) / slope, 1, 1e-4 + tolerance);
                // Texels per metre to the right and up.
                glm::dvec2 texels[2];
                for (int axis = 0; axis < 2; ++axis) {
                    const glm::dvec3 way = step * view.axes[axis];
                    texels[axis] = glm::dvec2(uvd_of(m, convention, p + way) - uvd_of(m, convention, p - way)) *
                                   glm::dvec2(size.width, size.height) / (2 * step);
                }
                // A texel's area, and the length of a metre in any direction between both sizes.
                const TexelSize texel = view.texel_size_at(p, size);
                const double area = std::abs(texels[0].x * texels[1].y - texels[0].y * texels[1].x);
                EXPECT_NEAR(texel.longest * texel.shortest * area, 1, 1e-4 + tolerance);
                double least = 1e300, most = 0;
                for (double angle = 0; angle < 3.1416; angle += 0.001) {
                    const double length = glm::length(std::cos(angle) * texels[0] + std::sin(angle) * texels[1]);
                    least = std::min(least, length);
                    most = std::max(most, length);
                }
                EXPECT_NEAR(texel.longest * least, 1, 1e-4 + tolerance);
                EXPECT_NEAR(texel.shortest * most, 1, 1e-4 + tolerance);
            }
}

TEST(ViewOfMatrix, TexelsOfOrthographicViewsFollowBothSides) {
    LightView view;
    view.set_half_extents({3, 1});
    EXPECT_DOUBLE_EQ(view.texel_size_range({1024, 128}).longest, 2.0 / 128);
    EXPECT_DOUBLE_EQ(view.texel_size_range({1024, 128}).shortest, 6.0 / 1024);
    EXPECT_DOUBLE_EQ(view.texel_size_range({384, 128}).longest, view.texel_size_range({384, 128}).shortest);
    EXPECT_EQ(view.half_extents(), glm::dvec2(3, 1));
}

TEST(ViewOfMatrix, TexelsOfPerspectiveViewsGrowWithDistance) {
    LightView view;
    view.curve = {.perspective = true, .near = 2, .far = 8, .convention = {}, .warp = {}};
    view.set_half_extents({0.5, 1});
    EXPECT_DOUBLE_EQ(view.texel_size_range({512, 128}).longest, 2 * 1 * 8.0 / 128);
    EXPECT_DOUBLE_EQ(view.texel_size_range({512, 128}).shortest, 2 * 0.5 * 2.0 / 512);
    EXPECT_DOUBLE_EQ(view.texel_size(4, {512, 128}), 2 * 1 * 4.0 / 128);
    EXPECT_TRUE(view.stretched({512, 128}));
    EXPECT_FALSE(view.stretched({128, 256}));
}

TEST(ViewOfMatrix, FindsTheEyeOfCubeFaces) {
    const std::vector<std::pair<glm::dvec3, glm::dvec3>> faces = {{{1, 0, 0}, {0, -1, 0}}, {{-1, 0, 0}, {0, -1, 0}},
                                                                  {{0, 1, 0}, {0, 0, 1}},  {{0, -1, 0}, {0, 0, -1}},
                                                                  {{0, 0, 1}, {0, -1, 0}}, {{0, 0, -1}, {0, -1, 0}}};
    const DepthCurve curve{.perspective = true, .near = 0.1, .far = 25, .convention = {}, .warp = {}};
    for (const auto& [forward, up] : faces) {
        const glm::dmat3 axes(glm::cross(forward, up), up, -forward);
        const glm::dmat4 m = 7.0 * clip_from_relative(projection_matrix(curve, 1, 1), axes, kEye, glm::dvec3(0));
        const LightView view = view_of_matrix(in_floats(m), {});
        EXPECT_LT(glm::distance(view.eye, kEye), 1e-4);
        for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(view.axes[i], axes[i]), 1e-5);
        EXPECT_NEAR(view.curve.near, 0.1, 1e-5);
        EXPECT_NEAR(view.curve.far, 25, 0.01);
        EXPECT_FALSE(view.warped() || view.stretched(512));
        EXPECT_NEAR(view.texel_size(5, 512), 2 * 5.0 / 512, 1e-6);
    }
}

TEST(ViewOfMatrix, DerivesAllFromParallelAndPerspectiveMatrices) {
    for (const bool perspective : {false, true})
        for (const bool reversed : {false, true})
            for (const bool zero_to_one : {false, true}) {
                const DepthConvention convention{zero_to_one, reversed};
                const DepthCurve curve{perspective, 2, 30, convention, {}};
                const glm::dmat4 m = from_world(off_centre(curve, {-0.7, -0.2}, {1.5, 0.9}));
                const LightView view = view_of_matrix(m, convention);
                EXPECT_EQ(view.curve.perspective, perspective);
                EXPECT_NEAR(view.curve.far - view.curve.near, 28, 1e-6);
                expect_as_matrix(view, m, {1024, 256}, 1e-9);
                expect_as_matrix(view_of_matrix(in_floats(m), convention), m, {1024, 256}, 1e-3);
            }
}

TEST(ViewOfMatrix, DerivesAllFromRangesWithoutEnd) {
    for (const bool reversed : {false, true})
        for (const bool zero_to_one : {false, true})
            for (const double near : {0.01, 0.1, 4.0}) {
                const DepthConvention convention{zero_to_one, reversed};
                const glm::dmat4 m = from_world(endless_projection(near, convention));
                for (const glm::dmat4& given : {m, in_floats(m)}) {
                    const LightView view = view_of_matrix(given, convention);
                    EXPECT_NEAR(view.curve.near / near, 1, 1e-4);
                    EXPECT_LT(glm::distance(view.eye, kEye), 1e-4);
                    for (const double times : {1.5, 10.0, 200.0}) {
                        const glm::dvec3 p = view.position_ws({0.3, 0.8}, times * near);
                        const double depth = reversed ? 1 / times : 1 - 1 / times;
                        EXPECT_NEAR(view.curve.depth(times * near), depth, 2e-4);
                        EXPECT_NEAR(uvd_of(m, convention, p).z, depth, 2e-4);
                        EXPECT_NEAR(view.curve.distance(depth) / (times * near), 1, 1e-3);
                    }
                }
            }
}

TEST(ViewOfMatrix, DerivesAllFromMirroredMaps) {
    const DepthCurve curve{true, 2, 30, {}, {}};
    glm::dmat4 projection = projection_matrix(curve, 0.5, 0.5);
    projection[1][1] *= -1;
    const LightView view = view_of_matrix(from_world(projection), {});
    expect_as_matrix(view, from_world(projection), 512, 1e-9);
}

TEST(ViewOfMatrix, SquareViewsInFloatsStaySquare) {
    const DepthCurve curve{false, 2, 30, {}, {}};
    const LightView view = view_of_matrix(in_floats(from_world(projection_matrix(curve, 12, 12))), {});
    EXPECT_FALSE(view.warped());
    EXPECT_NEAR(view.half_extent(), 12, 1e-4);
}

TEST(ViewOfMatrix, DerivesAllFromWarpedMatrices) {
    for (const bool reversed : {false, true}) {
        const DepthConvention convention{true, reversed};
        const glm::dmat4 m = 3.0 * from_world(warped_projection(reversed));
        const LightView view = view_of_matrix(m, convention);
        ASSERT_TRUE(view.warped());
        expect_as_matrix(view, m, 512, 1e-9);
        // 1 / w falls by the closed form from 1 + k y at y = (v - 1/2) 2 / (0.2 - k (2 v - 1)).
        const double first = 1 - 0.05 / 0.25, last = 1 + 0.05 / 0.15;
        EXPECT_NEAR(1 + view.curve.warp->rise, first / last, 1e-9);
        const DepthCurve row = view.curve.curve_at_row(1);
        EXPECT_NEAR(row.far - row.near, 8 * last, 1e-9);
        EXPECT_NEAR(view.relative_dw_per_m(view.position_ws({0.5, 0.5}, 5)), 0.05, 1e-9);
    }
}

TEST(ViewOfMatrix, DerivesAllFromShearedMatrices) {
    const DepthCurve curve{false, 2, 30, {}, {}};
    glm::dmat4 projection = projection_matrix(curve, 4, 3);
    projection[1][0] = 0.1;
    const LightView view = view_of_matrix(from_world(projection), {});
    EXPECT_TRUE(view.warped());
    expect_as_matrix(view, from_world(projection), {256, 1024}, 1e-9);
}

TEST(ViewOfMatrix, RefusesMatricesThatNoMapHas) {
    const auto error_of = [](const glm::dmat4& m, const DepthConvention& convention) -> std::string {
        try {
            view_of_matrix(m, convention);
        } catch (const Error& e) {
            return e.what();
        }
        return {};
    };
    const DepthCurve curve{true, 2, 30, {}, {}};
    const glm::dmat4 good = from_world(projection_matrix(curve, 1, 1));
    EXPECT_EQ(error_of(good, {}), "");
    EXPECT_NE(error_of(good, {.reversed = true}), "");
    EXPECT_NE(error_of(glm::dmat4(0.0), {}), "");
    EXPECT_NE(error_of(good * std::nan(""), {}), "");
    EXPECT_NE(error_of(-good, {}), "");
    EXPECT_NE(error_of(from_world(endless_projection(0.1, {.reversed = true})), {}), "");
    glm::dmat4 oblique = projection_matrix(curve, 1, 1);
    oblique[0][2] = 0.2;
    EXPECT_NE(error_of(from_world(oblique), {}), "");
    glm::dmat4 by_column(0.0);
    by_column = warped_projection(false);
    by_column[0][3] = 0.05;
    EXPECT_NE(error_of(from_world(by_column), {}), "");
}

}  // namespace
}  // namespace si
