// Tests of depth curves: stored depth over distance, steps and slopes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/projection/projection.h"

namespace si {
namespace {

struct CurveCase {
    bool perspective, zero_to_one, reversed;
    double near, far;
};

std::vector<CurveCase> curve_cases() {
    std::vector<CurveCase> cases;
    for (bool perspective : {false, true})
        for (bool zero_to_one : {false, true})
            for (bool reversed : {false, true}) {
                for (auto [n, f] : {std::pair{0.1, 100.0}, {0.01, 1000.0}, {1.0, 1.001}, {1e-6, 1e-3}, {10.0, 1e7}})
                    cases.push_back({perspective, zero_to_one, reversed, n, f});
                if (!perspective) cases.push_back({false, zero_to_one, reversed, -3.0, 5.0});
            }
    return cases;
}

DepthCurve curve_of(const CurveCase& c) {
    DepthCurve curve;
    curve.perspective = c.perspective;
    curve.near = c.near;
    curve.far = c.far;
    curve.convention = {c.zero_to_one, c.reversed};
    return curve;
}

class DepthCurves : public testing::TestWithParam<CurveCase> {};

TEST_P(DepthCurves, EndsAreExact) {
    const DepthCurve c = curve_of(GetParam());
    EXPECT_EQ(c.depth(c.near), c.convention.near_depth());
    EXPECT_EQ(c.depth(c.far), c.convention.far_depth());
    EXPECT_DOUBLE_EQ(c.distance(c.convention.near_depth()), c.near);
    EXPECT_DOUBLE_EQ(c.distance(c.convention.far_depth()), c.far);
}

TEST_P(DepthCurves, MetresAndDepthTowardsTheLightAreInverse) {
    const DepthCurve c = curve_of(GetParam());
    const double sign = c.convention.reversed ? 1 : -1;
    for (const double share : {0.1, 0.5, 0.9, 1.0})
        for (const double part : {-0.4, 1e-6, 0.3, 0.95}) {
            const double z = c.near + share * (c.far - c.near), metres = part * (c.perspective ? z : c.far - c.near);
            const double depth = c.depth_change_towards_light(z, metres);
            EXPECT_NEAR(c.metres_towards_light(z, depth) / metres, 1, 1e-9);
            if (c.perspective && z - metres < c.near) continue;  // depths in front of the near plane have no meaning
            const double moved = sign * (c.depth(z - metres) - c.depth(z));
            EXPECT_NEAR(depth, moved, 1e-12 + 1e-9 * std::abs(moved));
        }
    EXPECT_TRUE(std::isinf(c.metres_towards_light(c.far, std::numeric_limits<double>::infinity())));
    if (c.perspective) {
        EXPECT_LT(c.metres_towards_light(c.far, 1e300), c.far * (1 + 1e-12)) << "no farther than to the light";
        EXPECT_TRUE(std::isfinite(c.depth_change_towards_light(c.far, 10 * c.far)));
    }
}

TEST_P(DepthCurves, DistanceInvertsDepth) {
    const DepthCurve c = curve_of(GetParam());
    for (int i = 0; i <= 1000; ++i) {
        const double t = i / 1000.0;
        const double z = c.perspective ? c.near * std::pow(c.far / c.near, t) : c.near + t * (c.far - c.near);
        const double d = c.depth(z);
        // Size of a few roundings of d in metres.
        const double tolerance = 8 * 0x1p-53 * (1 / c.slope(z) + std::abs(z) + (c.far - c.near) * 1e-3);
        ASSERT_NEAR(c.distance(d), z, tolerance) << "at " << z;
        // Stored depths are floats: rounding moves the distance by at most half a step of the float.
        const float stored = float(d);
        const double step = double(std::nextafter(stored, 2.0f)) - stored;
        // The curve bends: at half a step the slope may differ slightly.
        const double moved = std::abs(c.distance(stored) - z);
        ASSERT_LE(moved, 0.5 * step / c.slope(z) * 1.01 + std::pow(step / c.slope(z), 2) / std::abs(z) + tolerance)
            << "at " << z;
    }
}

TEST_P(DepthCurves, SlopeIsTheDerivative) {
    const DepthCurve c = curve_of(GetParam());
    for (double t : {0.01, 0.2, 0.5, 0.8, 0.99}) {
        const double z = c.near + t * (c.far - c.near), h = 1e-5 * (c.perspective ? z : c.far - c.near);
        const double difference = std::abs(c.depth(z + h) - c.depth(z - h)) / (2 * h);
        EXPECT_NEAR(difference / c.slope(z), 1.0, 1e-3) << "at " << z;
    }
}

TEST_P(DepthCurves, MatrixGivesTheSameDepth) {
    const DepthCurve c = curve_of(GetParam());
    const glm::dmat4 m = projection_matrix(c, 0.7, 0.4);
    for (double t : {0.0, 1e-3, 0.3, 0.7, 1.0}) {
        const double z = c.near + t * (c.far - c.near);
        const glm::dvec4 clip = m * glm::dvec4(0.1, -0.2, -z, 1);
        const double ndc = clip.z / clip.w;
        const double scale = std::max(1.0, std::abs(z) / (c.far - c.near));
        EXPECT_NEAR(c.convention.zero_to_one ? ndc : 0.5 * ndc + 0.5, c.depth(z), 1e-12 * scale) << "at " << z;
        EXPECT_NEAR(clip.x / clip.w, 0.1 / (0.7 * (c.perspective ? z : 1)), 1e-9 * std::abs(clip.x / clip.w));
        EXPECT_NEAR(clip.y / clip.w, -0.2 / (0.4 * (c.perspective ? z : 1)), 1e-9 * std::abs(clip.y / clip.w));
        EXPECT_EQ(clip.w, c.perspective ? z : 1.0);
    }
}

INSTANTIATE_TEST_SUITE_P(All, DepthCurves, testing::ValuesIn(curve_cases()), [](const auto& named) {
    const CurveCase& c = named.param;
    return std::string(c.perspective ? "perspective" : "orthographic") + (c.zero_to_one ? "_01" : "_11") +
           (c.reversed ? "_reversed" : "_standard") + "_" + std::to_string(named.index);
});

// Accuracy table of the literature: size of a fixed-point step in metres at the far plane.
TEST(DepthCurve, HasKnownSteps) {
    DepthCurve c;
    c.perspective = true;
    c.near = 0.1;
    c.far = 100;
    EXPECT_NEAR(1.0 / 65535 / c.slope(100), 1.52, 0.01);
    EXPECT_NEAR(1.0 / ((1 << 24) - 1) / c.slope(100), 5.95e-3, 1e-4);
    c.near = 0.01;
    c.far = 1000;
    EXPECT_NEAR(1.0 / ((1 << 24) - 1) / c.slope(1000), 5.96, 0.01);
}

TEST(Projection, MapCoordinatesRunFrom0To1WhereClipSpaceDoes) {
    for (const bool zero_to_one : {true, false}) {
        const DepthConvention convention{.zero_to_one = zero_to_one};
        const double first = zero_to_one ? 0 : -1;
        for (const double w : {1.0, 3.0})
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 uvd(corner & 1, corner >> 1 & 1, corner >> 2);
                const glm::dvec3 ndc(uvd.x == 0 ? -1 : 1, uvd.y == 0 ? -1 : 1, uvd.z == 0 ? first : 1);
                EXPECT_EQ(uvd_from_ndc(convention, ndc), uvd);
                EXPECT_EQ(uvd_from_clip(convention) * glm::dvec4(ndc * w, w), glm::dvec4(uvd * w, w));
            }
    }
}

}  // namespace
}  // namespace si
