// Tests of a map's limits: steps of depth and texels, compared with closed forms.
#include "renderer/view/fits/map_limits.h"

#include <gtest/gtest.h>

#include "renderer/settings/param.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/box_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

/// Makes a box 4 m wide, 2 m high and 6 m deep, away from the origin.
Scene box() {
    return test::box_scene({{{100, 50, -30}, {104, 52, -24}}});
}

FittedLight fitted(const Sets& sets) {
    return fit_lights(box(), settings_with({}, sets))[0];
}

bool reports(const FittedLight& light, const char* what) {
    return std::any_of(light.notes.begin(), light.notes.end(),
                       [&](const std::string& n) { return n.find(what) != std::string::npos; });
}

TEST(MapLimits, OrdinaryMapsHaveNone) {
    for (const char* type : {"directional", "spot", "point"})
        for (const char* format : {"d16", "d24", "d32f", "colour", "linear", "linear16"})
            for (const char* azimuth : {"-40", "0", "90"}) {
                const FittedLight light =
                    fitted({{"light.type", type}, {"map.format", format}, {"light.azimuth", azimuth}});
                EXPECT_FALSE(light.limits.any()) << type << " " << format << " " << azimuth;
                EXPECT_TRUE(light.notes.empty()) << type;
            }
}

TEST(MapLimits, DepthRangeInOneStepIsReported) {
    // A light from overhead sees a depth of 2 m. 16 bits over 0 ... far step by far / 65535.
    const auto overhead = [](const char* format, const char* far, const char* reversed = "false") {
        return fitted({"light.elevation=90",
                       "light.azimuth=0",
                       "light.fit=manual",
                       {"light.far", far},
                       "light.near=0.001",
                       "light.distance=10",
                       {"map.format", format},
                       {"map.reversed_z", reversed}});
    };
    const FittedLight coarse = overhead("d16", "140000");
    EXPECT_TRUE(coarse.limits.one_depth_step);
    EXPECT_NEAR(coarse.limits.step_m, 140000 / 65535.0, 1e-3);
    EXPECT_NEAR(coarse.limits.depth_m, 2, 1e-9);
    EXPECT_TRUE(reports(coarse, "one step of map.format (2.14 m)"));
    EXPECT_FALSE(overhead("d16", "120000").limits.one_depth_step) << "a step is 1.83 m";
    EXPECT_FALSE(overhead("d24", "140000").limits.any()) << "256 times finer";
    EXPECT_TRUE(overhead("d24", "40000000").limits.one_depth_step);
    EXPECT_FALSE(overhead("d32f", "40000000").limits.any())
        << "floats are fine near 0, where this light's near plane is";
    EXPECT_TRUE(overhead("d32f", "100000000", "true").limits.one_depth_step) << "reversed, the scene lies near 1";
}

TEST(MapLimits, PerspectiveDepthNearTheFarPlaneIsReported) {
    // d = far (z - near) / (z (far - near)): between z and z + 2 it moves by about 2 near / z^2.
    const auto spot = [](const char* near, const char* format) {
        return fitted({"light.type=spot",
                       "light.elevation=90",
                       "light.azimuth=0",
                       "light.fit=manual",
                       {"light.near", near},
                       "light.far=1000",
                       "light.distance=100",
                       {"map.format", format}});
    };
    EXPECT_FALSE(spot("10", "d16").limits.any());
    const FittedLight crowded = spot("0.01", "d16");
    EXPECT_TRUE(crowded.limits.one_depth_step) << "2e-6 against a step of 1.5e-5";
    EXPECT_TRUE(reports(crowded, "no bias separates casters from receivers"));
    EXPECT_FALSE(spot("0.1", "d16").limits.any()) << "2e-5 against 1.5e-5";
}

TEST(MapLimits, TexelLargerThanTheSceneIsReported) {
    const auto light = [](const char* resolution, const char* extent) {
        return fitted({"light.elevation=90",
                       "light.azimuth=0",
                       "light.fit=manual",
                       {"light.extent", extent},
                       {"map.resolution", resolution}});
    };
    const FittedLight coarse = light("64", "320");
    EXPECT_TRUE(coarse.limits.one_texel);
    EXPECT_DOUBLE_EQ(coarse.limits.texel_m, 10);
    EXPECT_NEAR(coarse.limits.across_m, 6, 1e-9);
    EXPECT_TRUE(reports(coarse, "one texel (10 m) is larger than the scene (6 m across)"));
    EXPECT_FALSE(light("128", "320").limits.one_texel) << "5 m";
    EXPECT_TRUE(fitted({"map.resolution=1"}).limits.one_texel);
}

TEST(MapLimits, FlatSceneHasNoDepthLimit) {
    Settings s = settings_with({}, {"light.elevation=90", "light.azimuth=0"});
    const FittedLight light = fit_lights(test::box_scene({{{0, 3, 0}, {5, 3, 5}}}), s)[0];
    EXPECT_FALSE(light.limits.one_depth_step);
}

TEST(MapLimits, AnExtentOfNextToNothingIsReported) {
    for (const char* type : {"directional", "spot"}) {
        Sets sets = {{"light.type", type}, {"light.projection", "orthographic"}, {"light.fit", "manual"}};
        sets.push_back({"light.extent", "1e-30"});
        EXPECT_TRUE(reports(fitted(sets), "light.extent")) << type;
        sets.back() = {"light.extent", "0.01"};
        EXPECT_FALSE(reports(fitted(sets), "light.extent")) << type;
    }
}

TEST(MapLimits, OnlyLightsWithAMapHaveSome) {
    EXPECT_TRUE(fitted({"map.resolution=1", "light.cast=false"}).notes.empty());
}

}  // namespace
}  // namespace si
