// Tests of the bias theory, compared with brute force over texels and with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/base/directions.h"
#include "renderer/bias/theory.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/box_scene.h"

namespace si {
namespace {

/// Random map view with a plane in front.
struct LitPlane {
    LightView view;
    glm::dvec3 point, normal;
};

LitPlane random_plane(std::mt19937& random, bool perspective, bool reversed) {
    std::uniform_real_distribution<double> unit(-1, 1);
    Settings s;
    s.lights[0].type = perspective ? LightType::Spot : LightType::Directional;
    s.lights[0].azimuth = 180 * unit(random);
    s.lights[0].elevation = 90 * unit(random);
    s.map.reversed_z = reversed;
    LitPlane lit;
    lit.view = fit_lights(test::box_scene({{glm::dvec3(-2), glm::dvec3(2)}}), s)[0].views[0];
    lit.point = 0.5 * glm::dvec3(unit(random), unit(random), unit(random));
    const glm::dvec3 to_light = perspective ? glm::normalize(lit.view.eye - lit.point) : lit.view.axes[2];
    const double theta = (0.5 + 0.48 * unit(random)) * M_PI / 2, phi = M_PI * unit(random);
    const glm::dmat3 basis = orthonormal_basis(to_light);
    lit.normal = basis * glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    return lit;
}

glm::dvec3 uvd_of(const LightView& view, const glm::dvec3& p) {
    const glm::dvec4 q = view.clip_from_relative(p)[3];
    return {0.5 * q.x / q.w + 0.5, 0.5 * q.y / q.w + 0.5, q.z / q.w};
}

/// Returns the largest depth by which a receiver on the plane is behind a texel of its kernel, searched over the
/// receiver's place within a texel. Taps (2R+1)^2, each the nearest texel or the four around.
double brute_force(const LitPlane& lit, int radius, bool bilinear, int resolution) {
    const ReceiverPlane start = receiver_plane(lit.view, lit.point, lit.normal);
    // The world point of the plane at map position (u, v), on the light's ray and independent of the theory.
    const auto depth_at = [&](double u, double v) {
        const double x = (2 * u - 1) * lit.view.half_extent(), y = (2 * v - 1) * lit.view.half_extent();
        const glm::dvec3 aside = lit.view.axes[0] * x + lit.view.axes[1] * y, back = lit.view.axes[2];
        const bool p = lit.view.curve.perspective;
        const glm::dvec3 origin = p ? lit.view.eye : lit.view.eye + aside;
        const glm::dvec3 dir = p ? aside - back : -back;
        const double z = glm::dot(lit.point - origin, lit.normal) / glm::dot(dir, lit.normal);
        return lit.view.curve.depth(z);
    };
    const double sign = lit.view.curve.convention.reversed ? -1 : 1;
    const glm::dvec2 texel0 = glm::floor(glm::dvec2(start.uvd) * double(resolution));
    double worst = 0;
    const int steps = 64;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            // Phases reach a thousandth of a texel from its sides.
            const glm::dvec2 f = 0.001 + 0.998 * glm::dvec2(i, j) / double(steps - 1);
            const glm::dvec2 at = texel0 + f;
            const double own = depth_at(at.x / resolution, at.y / resolution);
            const glm::dvec2 first = bilinear ? glm::floor(at - 0.5) - double(radius) : glm::floor(at) - double(radius);
            const int size = 2 * radius + (bilinear ? 2 : 1);
            for (int y : {0, size - 1})
                for (int x : {0, size - 1}) {
                    const glm::dvec2 centre = (first + glm::dvec2(x, y) + 0.5) / double(resolution);
                    worst = std::max(worst, sign * (own - depth_at(centre.x, centre.y)));
                }
        }
    return worst;
}

TEST(BiasTheory, MinimumBiasMatchesASearchOverTexelPhases) {
    std::mt19937 random(5);
    for (bool perspective : {false, true})
        for (bool reversed : {false, true})
            for (int radius : {0, 1, 2})
                for (bool bilinear : {false, true})
                    for (int i = 0; i < 6; ++i) {
                        const LitPlane lit = random_plane(random, perspective, reversed);
                        const ReceiverPlane plane = receiver_plane(lit.view, lit.point, lit.normal);
                        const double kappa = radius + (bilinear ? 1 : 0.5);
                        const double predicted = least_bias(plane.gradient, kappa, 1024, 0, 0).total();
                        const double measured = brute_force(lit, radius, bilinear, 1024);
                        // Phases stop a thousandth before the texel's sides, and curved depth is not tested here.
                        EXPECT_LE(measured / predicted, 1 + 1e-6) << perspective << reversed << radius << bilinear;
                        EXPECT_GE(measured / predicted, 0.97) << perspective << reversed << radius << bilinear;
                    }
}

TEST(BiasTheory, PlaneIsAffineInTheMap) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const LitPlane s = random_plane(random, i % 2, i % 4 > 1);
        const ReceiverPlane plane = receiver_plane(s.view, s.point, s.normal);
        const glm::dmat3 in_plane = orthonormal_basis(glm::normalize(s.normal));
        const glm::dvec3 q = s.point + 0.3 * unit(random) * in_plane[0] + 0.3 * unit(random) * in_plane[1];
        const glm::dvec3 uvd = uvd_of(s.view, q);
        EXPECT_NEAR(plane.depth_at({uvd.x, uvd.y}), uvd.z, 1e-11);
    }
}

TEST(BiasTheory, NormalOffsetReplacesTheBias) {
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        const LitPlane s = random_plane(random, i % 2, i % 4 > 1);
        const ReceiverPlane plane = receiver_plane(s.view, s.point, s.normal);
        const double b_min = least_bias(plane.gradient, 1, 4096, 0, 0).total();
        const double h = least_normal_offset(s.view, s.point, s.normal, b_min);
        // The plane shifted by h is nearer by b_min at the old point's map coordinates, to first order in h.
        const ReceiverPlane moved = receiver_plane(s.view, s.point + h * glm::normalize(s.normal), s.normal);
        const double gained = std::abs(plane.uvd.z - moved.depth_at({plane.uvd.x, plane.uvd.y}));
        EXPECT_NEAR(gained / b_min, 1, 0.02) << i;
        if (!s.view.curve.perspective) {
            const double texel = s.view.texel_size(1, 4096);
            EXPECT_LE(h, std::sqrt(2.0) * texel * 1.0001);
        }
    }
}

TEST(BiasTheory, OrthographicClosedForm) {
    std::mt19937 random(8);
    for (int i = 0; i < 100; ++i) {
        const LitPlane s = random_plane(random, false, i % 2);
        const ReceiverPlane plane = receiver_plane(s.view, s.point, s.normal);
        const double theta = std::acos(glm::dot(glm::normalize(s.normal), s.view.axes[2]));
        const glm::dvec3 in_map = glm::transpose(s.view.axes) * glm::normalize(s.normal);
        const double phi = std::atan2(in_map.y, in_map.x), texel = s.view.texel_size(1, 512);
        const double expected = 0.5 * texel * std::tan(theta) * (std::abs(std::cos(phi)) + std::abs(std::sin(phi)));
        const double b = least_bias(plane.gradient, 0.5, 512, 0, 0).total();
        EXPECT_NEAR(s.view.curve.metres_towards_light(1, b) / expected, 1, 1e-9);
    }
}

TEST(BiasTheory, PartsAddUp) {
    const LeastBias b = least_bias({3, -4}, 0.5, 1024, 1e-5, 8);
    EXPECT_DOUBLE_EQ(b.kernel, 3.5 / 1024);
    EXPECT_DOUBLE_EQ(b.snapping, 7.0 / 1024 / 512);
    EXPECT_DOUBLE_EQ(b.total(), b.kernel + b.snapping + 1e-5);
}

TEST(BiasTheory, RoundingComesFromCoordinatesOrDepth) {
    LightView view;
    view.curve = {false, 0, 10, {}};
    EXPECT_DOUBLE_EQ(rounding_bias(view, {0, 0, -1}, 50), 4 * 0x1p-23 * 50 / 10);
    view.curve = {true, 1e-3, 10, {}};
    EXPECT_NEAR(rounding_bias(view, {0, 0, -9}, 10), 4 * 0x1p-23, 1e-10);  // depths crowd at 1
    view.curve.convention.reversed = true;
    EXPECT_LT(rounding_bias(view, {0, 0, -9}, 10), 1e-3 * 4 * 0x1p-23);
}

TEST(BiasTheory, EdgeOnBiasIsInfiniteNotNan) {
    LightView view;
    view.curve = {false, 0, 10, {}};
    view.projection = fit_lights(Scene(), Settings())[0].views[0].projection;
    const ReceiverPlane plane = receiver_plane(view, {0, 0, -5}, {1, 0, 0});
    EXPECT_TRUE(std::isinf(plane.gradient.x));
    EXPECT_EQ(plane.gradient.y, 0);
    // Within a millionth of the light, the limit of single precision.
    for (const glm::dvec3 normal : {glm::dvec3(0, 1, 0), {0.6, 0.8, 0}, {0.6, -0.8, 9e-7}, {1, 0, -1e-17}, {0, 0, 0}}) {
        const ReceiverPlane edge = receiver_plane(view, {0.3, 0.1, -5}, normal);
        EXPECT_TRUE(edge.edge_on());
        EXPECT_FALSE(std::isnan(edge.gradient.x) || std::isnan(edge.gradient.y));
        EXPECT_EQ(edge.depth_at({0.9, 0.2}), edge.uvd.z);
        EXPECT_TRUE(std::isinf(least_bias(edge.gradient, 0.5, 512, 1e-6, 8).total()));
    }
    EXPECT_FALSE(receiver_plane(view, {0.3, 0.1, -5}, {0.6, -0.8, 2e-6}).edge_on());
}

TEST(BiasTheory, Quanta) {
    EXPECT_EQ(depth_quantum(MapFormat::D16, 0.3), 1.0 / 65535);
    EXPECT_EQ(depth_quantum(MapFormat::D24, 0.3), 1.0 / 16777215);
    EXPECT_EQ(depth_quantum(MapFormat::D32F, 0.6), 0x1p-24);
    EXPECT_EQ(depth_quantum(MapFormat::D32F, 0.3), 0x1p-25);
    EXPECT_EQ(depth_quantum(MapFormat::Colour, 1.0), 0x1p-23);
    EXPECT_GT(depth_quantum(MapFormat::D32F, 0.0), 0);
    // Equal steps of distance, as depths by the curve, and their rounding.
    for (const bool reversed : {false, true}) {
        const DepthCurve curve{true, 0.5, 20, {true, reversed}};
        for (const double z : {0.6, 5.0, 19.0}) {
            const double step_m = depth_quantum(MapFormat::Linear16, curve, curve.depth(z)) / curve.slope(z);
            EXPECT_NEAR(step_m, 19.5 / 65535, 1e-5 + 4 * 0x1p-23 * z * z);
            // A value of a 16-bit map at that distance is off by at most half a step.
            const double share = (reversed ? 20 - z : z - 0.5) / 19.5, kept = std::round(share * 65535) / 65535;
            EXPECT_LE(std::abs(curve.distance(curve.depth_at_fraction(kept)) - z), 0.5 * step_m);
        }
        EXPECT_EQ(curve.depth_at_fraction(0), 0);
        EXPECT_EQ(curve.depth_at_fraction(1), 1);
        EXPECT_TRUE(std::isnan(curve.depth_at_fraction(std::nan(""))));
    }
    const DepthCurve parallel{false, 0, 10, {}};
    EXPECT_EQ(parallel.depth_at_fraction(0.3), 0.3);
    EXPECT_EQ(depth_quantum(MapFormat::Linear16, parallel, 0.3), 1.0 / 65535);
}

// Gaps that users of another engine measured at 52 degrees for four biases.
TEST(BiasTheory, ContactGap) {
    const double theta = 52 * M_PI / 180;
    EXPECT_NEAR(contact_gap(2.02, theta), 1.6, 0.15);
    EXPECT_NEAR(contact_gap(4.12, theta), 3.2, 0.15);
    EXPECT_NEAR(contact_gap(6.71, theta), 5.3, 0.15);
    EXPECT_NEAR(contact_gap(13.29, theta), 10.4, 0.15);
}

}  // namespace
}  // namespace si
