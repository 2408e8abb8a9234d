// Tests of angles and directions in degrees.
#include "renderer/base/angles.h"

#include <gtest/gtest.h>

#include "renderer/base/directions.h"
#include "renderer/view/lights/light.h"

namespace si {
namespace {

TEST(Angles, QuartersAreExactAndZerosHaveNoSign) {
    constexpr double kSines[] = {0, 1, 0, -1};
    for (int quarter = -9; quarter <= 9; ++quarter) {
        const SineCosine a = sine_cosine(90.0 * quarter);
        EXPECT_EQ(a.sine, kSines[(quarter + 12) % 4]) << quarter;
        EXPECT_EQ(a.cosine, kSines[(quarter + 13) % 4]) << quarter;
        EXPECT_FALSE(a.sine == 0 && std::signbit(a.sine)) << quarter;
        EXPECT_FALSE(a.cosine == 0 && std::signbit(a.cosine)) << quarter;
    }
}

TEST(Angles, OtherAnglesMatchRadians) {
    for (double degrees = -720; degrees <= 720; degrees += 7.3) {
        const SineCosine a = sine_cosine(degrees);
        EXPECT_NEAR(a.sine, std::sin(degrees * std::numbers::pi / 180), 4e-15) << degrees;
        EXPECT_NEAR(a.cosine, std::cos(degrees * std::numbers::pi / 180), 4e-15) << degrees;
    }
}

TEST(Angles, AxisDirectionsAreExact) {
    for (const double azimuth : {-180.0, -90.0, 0.0, 33.0, 90.0, 180.0, 270.0})
        EXPECT_EQ(direction_from_angles(azimuth, 90), glm::dvec3(0, 1, 0)) << azimuth;
    EXPECT_EQ(direction_from_angles(-90, 0), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(direction_from_angles(180, 0), glm::dvec3(0, 0, -1));
    EXPECT_EQ(direction_from_angles(90, 30).z, 0);
}

}  // namespace
}  // namespace si
