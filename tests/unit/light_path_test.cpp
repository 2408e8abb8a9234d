// Tests of paths of lights: the sun's path against rotated vectors, straight paths, and the change between points.
#include "renderer/measure/light_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/base/directions.h"
#include "renderer/base/error.h"
#include "renderer/measure/sun_path.h"
#include "renderer/settings/param.h"
#include "tests/support/error_text.h"

namespace si {
namespace {

constexpr double kRad = std::numbers::pi / 180;

TEST(SunPath, DeclinationHasItsKnownTurningPoints) {
    EXPECT_NEAR(sun_declination_deg(172), 23.44, 0.05) << "21 June";
    EXPECT_NEAR(sun_declination_deg(355), -23.44, 0.05) << "21 December";
    EXPECT_NEAR(sun_declination_deg(80), 0, 0.5) << "21 March";
}

// The sky turns about the pole, which stands as high as the latitude above the north.
TEST(SunPath, PositionsAreThoseOfAVectorThatTurnsAboutThePole) {
    for (const double latitude : {-70.0, -33.9, 0.0, 48.2, 66.0, 89.0})
        for (const int day : {1, 80, 172, 300})
            for (const double hour : {1.0, 6.5, 9.0, 12.0, 15.5, 23.0}) {
                const double phi = latitude * kRad, delta = sun_declination_deg(day) * kRad,
                             turn = (hour - 12) * 15 * kRad;
                const glm::dvec3 pole(0, std::sin(phi), -std::cos(phi)), meridian(0, std::cos(phi), std::sin(phi)),
                    west(-1, 0, 0);
                const glm::dvec3 expected =
                    std::sin(delta) * pole + std::cos(delta) * (std::cos(turn) * meridian + std::sin(turn) * west);
                const SunPosition sun = sun_position(latitude, day, hour);
                const glm::dvec3 at = direction_from_angles(sun.azimuth_deg, sun.elevation_deg);
                EXPECT_LT(glm::length(at - expected), 1e-12) << latitude << ", " << day << ", " << hour;
            }
}

TEST(SunPath, GoesFromSunriseToSunsetWithoutJumps) {
    const std::vector<SunPosition> summer = sun_path(48, 172, 200);
    ASSERT_EQ(summer.size(), 200u);
    const double hours = 200 * (summer[1].hour - summer[0].hour);
    EXPECT_NEAR(hours, 15.8, 0.1) << "the longest day at 48 degrees north";
    EXPECT_NEAR(summer.front().elevation_deg, 0, 0.5);
    EXPECT_NEAR(summer.back().elevation_deg, 0, 0.5);
    for (const double latitude : {48.0, -48.0, 10.0, 80.0}) {
        const std::vector<SunPosition> path = sun_path(latitude, 172, 60);
        for (std::size_t i = 0; i < path.size(); ++i) {
            EXPECT_GT(path[i].elevation_deg, 0) << latitude;
            EXPECT_LE(std::abs(path[i].azimuth_deg), 360) << latitude;
            if (i > 0) {
                EXPECT_LT(std::abs(path[i].azimuth_deg - path[i - 1].azimuth_deg), 90) << latitude << ", " << i;
            }
        }
        EXPECT_GT(path.front().azimuth_deg, 0) << "it rises in the east";
    }
    EXPECT_NEAR(sun_path(80, 172, 24).back().hour - sun_path(80, 172, 24).front().hour, 23, 1e-9) << "a polar day";
    EXPECT_TRUE(sun_path(80, 355, 24).empty()) << "a polar night";
}

TEST(LightPath, StraightPathsMoveAllSettingsTogether) {
    const Settings settings;
    const LightPath path = straight_path("light.azimuth=-30:60,light.0.elevation=10:40", 4, settings);
    ASSERT_EQ(path.points.size(), 4u);
    using Values = std::vector<std::pair<std::string, std::string>>;
    EXPECT_EQ(path.points[0].values, (Values{{"light.azimuth", "-30"}, {"light.elevation", "10"}}));
    EXPECT_EQ(path.points[1].values, (Values{{"light.azimuth", "0"}, {"light.elevation", "20"}}));
    EXPECT_EQ(path.points[3].values, (Values{{"light.azimuth", "60"}, {"light.elevation", "40"}}));
    const Settings last = settings_at(settings, path.points[3]);
    EXPECT_EQ(last.lights[0].azimuth, 60);
    EXPECT_EQ(last.lights[0].elevation, 40);
}

TEST(LightPath, MistakesAreNamed) {
    Settings settings;
    const auto along = [&](const char* text, std::string_view reason) {
        return test::fails_with<UsageError>([&] { straight_path(text, 5, settings); }, {reason});
    };
    EXPECT_TRUE(along("", "is wanted"));
    EXPECT_TRUE(along("light.azimuth", "KEY=from:to"));
    EXPECT_TRUE(along("light.azimuth=1:x", "KEY=from:to"));
    EXPECT_TRUE(along("light.azimuth=1:2:3", "KEY=from:to"));
    EXPECT_TRUE(along("light.azimuth=1:2,", "KEY=from:to")) << "after a last comma";
    EXPECT_TRUE(along("light.azimut=1:2", "light.azimuth"));
    EXPECT_TRUE(along("bias.slope=1:2", "number of a light"));
    EXPECT_TRUE(along("light.type=0:1", "number of a light"));
    EXPECT_TRUE(along("light.elevation=0:91", "light.elevation"));
    EXPECT_TRUE(along("light.azimuth=1:2,light.0.azimuth=3:4", "twice"));
    EXPECT_TRUE(along("light.3.azimuth=1:2", "light.count"));
    EXPECT_TRUE(along("light.cone=20:40", "light.cone")) << "a sun has no cone";
    const auto day = [&](const char* text, std::string_view reason) {
        return test::fails_with<UsageError>([&] { day_path(text, 5, settings); }, {reason});
    };
    EXPECT_TRUE(day("48", "LATITUDE,DAY"));
    EXPECT_TRUE(day("91,1", "LATITUDE,DAY"));
    EXPECT_TRUE(day("48,0", "LATITUDE,DAY"));
    EXPECT_TRUE(day("48,1.5", "LATITUDE,DAY"));
    EXPECT_TRUE(day("80,355", "does not rise"));
    settings.lights[0].type = LightType::Spot;
    EXPECT_TRUE(day("48,172", "directional"));
}

/// Pictures of one row with these visibilities.
std::vector<ClassifiedPixel> drawn_row(std::initializer_list<float> visibilities) {
    std::vector<ClassifiedPixel> out;
    for (const float v : visibilities) out.push_back({.visibility = v});
    return out;
}

Reference reference_row(std::initializer_list<float> visibilities) {
    Reference out;
    out.width = int(visibilities.size());
    out.height = 1;
    out.visibility = {out.width, 1, 1, std::vector<float>(visibilities)};
    out.state.assign(visibilities.size(), PixelState::Counted);
    return out;
}

TEST(LightPath, ShimmerIsTheChangeBeyondTheReferences) {
    // The reference's edge moves over one pixel. One pixel follows it, one flickers, one fades, one stands still.
    Reference before = reference_row({1, 1, 1, 0, 1}), now = reference_row({0, 1, 1, 0, 1});
    now.state[4] = PixelState::FacesAway;
    const PathChange c = path_change(drawn_row({1, 1, 1, 0, 1}), before, drawn_row({0.25f, 0.25f, 0.75f, 0, 0}), now);
    EXPECT_EQ(c.pixels, 4u) << "a pixel that does not count at both points is left out";
    EXPECT_DOUBLE_EQ(c.drawn, (0.75 + 0.75 + 0.25) / 4);
    EXPECT_DOUBLE_EQ(c.reference, 0.25);
    EXPECT_DOUBLE_EQ(c.beyond, (0.75 + 0.25) / 4);
    EXPECT_EQ(c.flips, 1u) << "the second pixel crosses one half; the first does so with the reference";
    EXPECT_THROW(path_change(drawn_row({1}), before, drawn_row({1}), now), Error);
}

TEST(LightPath, TheWorstStepHasTheLargestError) {
    LightPathResult r;
    for (const double mae : {0.1, 0.3, 0.2}) {
        r.steps.push_back({});
        r.steps.back().error.mae = mae;
        r.steps.back().error.iou = 1 - mae / 10;
    }
    EXPECT_EQ(r.worst(*find_metric("mae")), 1u);
    EXPECT_EQ(r.worst(*find_metric("iou")), 1u) << "more is better";
    EXPECT_EQ(LightPathResult{}.worst(*find_metric("mae")), 0u);
}

TEST(LightPath, AStepWithoutAValueIsNotTheWorst) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    LightPathResult r;
    for (const double distance : {kNone, 1.0, kNone, 3.0, 2.0}) {
        r.steps.push_back({});
        r.steps.back().error.boundary_px_mean = distance;
    }
    EXPECT_EQ(r.worst(*find_metric("boundary_px_mean")), 3u);
    for (PathStep& step : r.steps) step.error.boundary_px_mean = kNone;
    EXPECT_EQ(r.worst(*find_metric("boundary_px_mean")), 0u);
}

}  // namespace
}  // namespace si
