// Tests of bias and gaps under spot and point lights, whose depth is not linear in metres.
#include <gtest/gtest.h>

#include "renderer/bias/account.h"
#include "renderer/scenes/shapes.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

/// Light 10 m above the middle of a floor, and a point of the floor whose ray has an angle to the axis.
struct Lit {
    Settings settings;
    FittedLight light;
    SurfacePoint point;
    explicit Lit(LightType type, bool reversed, double aside = 2) {
        settings.map.reversed_z = reversed;
        settings.lights[0].type = type;
        set_all(settings, {"light.azimuth=0", "light.elevation=90", "light.distance=10", "light.cone=60",
                           "light.fit=manual", "light.near=0.05", "light.far=12", "bias.kind=slope"});
        light = fit_lights(make_scene(make_plane(20, 20)), settings)[0];
        point.position_ws = {aside, 0, 0.5 * aside};
    }
    BiasBreakdown account() const { return bias_breakdown(light, settings, 512, point, {.subpixel_bits = 8}); }
};

TEST(LightReceiver, OneMetreOfBiasMovesOneMetreAlongTheAxis) {
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (const bool reversed : {false, true})
            for (const double offset_texels : {0.0, 3.0})
                for (const double metres : {1e-3, 1.0, 9.0}) {
                    Lit lit(type, reversed);
                    lit.settings.bias.unit = BiasUnit::Metres;
                    lit.settings.bias.constant = metres;
                    lit.settings.bias.normal = offset_texels;
                    const BiasBreakdown a = lit.account();
                    const DepthCurve& curve = lit.light.views[a.receiver.view].curve;
                    EXPECT_NEAR(curve.distance(a.receiver.tap.z) - curve.distance(a.receiver.compared), metres, 1e-9)
                        << int(type) << reversed;
                    EXPECT_NEAR(a.receiver.bias_m, metres, 1e-12);
                    lit.settings.bias.unit = BiasUnit::Texels;
                    lit.settings.bias.constant = metres / a.receiver.texel_m;
                    EXPECT_NEAR(lit.account().receiver.compared / a.receiver.compared, 1, 1e-12) << "texels are metres";
                }
}

// A light's square section divided into 600 x 150 texels: each is four times as high as wide.
TEST(LightReceiver, ATexelHasALongestAndAShortestSide) {
    for (const LightType type : {LightType::Directional, LightType::Spot}) {
        const Lit lit(type, false);
        const auto receiver = [&](MapSize size) {
            return bias_breakdown(lit.light, lit.settings, size, lit.point, {.subpixel_bits = 8}).receiver;
        };
        const LightReceiver oblong = receiver({600, 150});
        const LightReceiver fine = receiver(MapSize(600)), coarse = receiver(MapSize(150));
        EXPECT_NEAR(oblong.texel_m / oblong.texel_short_m, 4, 1e-9) << int(type);
        EXPECT_NEAR(oblong.texel_short_m / fine.texel_m, 1, 1e-9) << int(type);
        EXPECT_NEAR(oblong.texel_m / coarse.texel_m, 1, 1e-9) << int(type);
        EXPECT_NEAR(fine.texel_short_m / fine.texel_m, 1, 1e-9) << int(type);
    }
}

// Displayed amounts are distances along the ray, at any size: not the slope's 101 m for a light 10 m away.
TEST(LightReceiver, AmountsAreDistancesAlongTheRay) {
    for (const LightType type : {LightType::Spot, LightType::Point})
        for (const bool reversed : {false, true})
            for (const double aside : {0.0, 3.0}) {
                const Lit lit(type, reversed, aside);
                const BiasBreakdown a = lit.account();
                const DepthCurve& curve = lit.light.views[a.receiver.view].curve;
                const double distance = glm::distance(lit.light.position, lit.point.position_ws);
                EXPECT_NEAR(a.receiver.axis_per_ray, 10 / distance, 1e-12);
                for (const double gap_m : {1e-3, 1.0, 0.91 * distance}) {
                    // A surface nearer by that distance on the ray, by its position.
                    const double z = 10 * (1 - gap_m / distance);
                    const double depth = std::abs(curve.depth(10) - curve.depth(z));
                    EXPECT_NEAR(a.amount(depth).metres / gap_m, 1, 1e-9) << int(type);
                    EXPECT_NEAR(a.amount(depth).texels, (10 - z) / a.receiver.texel_m,
                                1e-9 * (10 - z) / a.receiver.texel_m);
                }
                EXPECT_LE(a.amount(1e9).metres, distance * (1 + 1e-9));
            }
}

TEST(BiasBreakdown, IsNeverNanEdgeOn) {
    for (const LightType type : {LightType::Directional, LightType::Spot})
        for (const double normal : {0.0, 1.0})
            for (const double raster : {0.0, 2.0}) {
                Lit lit(type, false, 0);
                lit.point.geometric = lit.point.bias_normal = {1, 0, 0};
                lit.settings.bias.normal = normal;
                lit.settings.bias.raster_slope = raster;
                lit.settings.bias.slope = 1;
                const BiasBreakdown a = lit.account();
                EXPECT_FALSE(faces_light(a.receiver.n_dot_l));
                EXPECT_TRUE(a.plane.edge_on());
                for (const double depth :
                     {a.constant, a.slope, a.normal, a.raster, a.equivalent_depth(), a.depth_shift, a.least.kernel,
                      a.least.quantum, a.least.snapping, a.least.rounding, a.least.total()}) {
                    const DepthShift amount = a.amount(depth);
                    EXPECT_FALSE(std::isnan(amount.depth) || std::isnan(amount.texels) || std::isnan(amount.metres));
                }
                EXPECT_TRUE(std::isinf(a.amount(a.least.total()).metres));
                EXPECT_FALSE(std::isnan(a.contact_gap_m()));
            }
}

// P of the minimum bias is the largest coordinate, relative to the picture's origin or to the map's.
TEST(BiasBreakdown, RoundingGrowsWithTheLargestCoordinateThatIsUsed) {
    Lit lit(LightType::Directional, false, 1);
    const double near = lit.account().least.rounding;
    lit.point.origin_ws = {0, 0, 1000};
    EXPECT_NEAR(lit.account().least.rounding, 4 * 0x1p-23 * 999.5 / (12 - 0.05), 1e-9);
    EXPECT_GT(lit.account().least.rounding, 10 * near);
    lit.point.origin_ws = {};
    lit.light.map_origin = {-2000, 0, 0};
    EXPECT_NEAR(lit.account().least.rounding, 4 * 0x1p-23 * 2001 / (12 - 0.05), 1e-9);
}

}  // namespace
}  // namespace si
