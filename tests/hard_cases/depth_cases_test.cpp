// Tests hard cases 3 to 5: stored depths of maps against distances computed in double.
#include <fmt/format.h>

#include <cmath>

#include "renderer/bias/theory.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/stability.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

struct StoredCase {
    LightType type;
    LightProjection projection;
    MapFormat format;
    bool reversed;
    double ratio;  ///< far / near; 0 leaves the fit
};

constexpr MapFormat kStoredFormats[] = {MapFormat::D16,    MapFormat::D24,    MapFormat::D32F,
                                        MapFormat::Colour, MapFormat::Linear, MapFormat::Linear16};

std::vector<StoredCase> stored_cases() {
    std::vector<StoredCase> cases;
    for (MapFormat format : kStoredFormats)
        for (bool reversed : {false, true}) {
            cases.push_back({LightType::Directional, LightProjection::Automatic, format, reversed, 0});
            cases.push_back({LightType::Directional, LightProjection::Perspective, format, reversed, 0});
            cases.push_back({LightType::Spot, LightProjection::Orthographic, format, reversed, 0});
            cases.push_back({LightType::Point, LightProjection::Automatic, format, reversed, 0});
            for (double ratio : {10.0, 1e3, 1e5})
                cases.push_back({LightType::Spot, LightProjection::Automatic, format, reversed, ratio});
        }
    return cases;
}

std::string case_name(const StoredCase& c) {
    const char* projections[] = {"", "_ortho", "_persp"};
    return fmt::format("{}{}_{}_{}{}", light_name(c.type), projections[int(c.projection)], format_name(c.format),
                       c.reversed ? "reversed" : "standard", c.ratio > 0 ? fmt::format("_{:.0f}", c.ratio) : "");
}

class StoredDepth : public testing::TestWithParam<StoredCase> {};

// Case 3 and 4: the linearised depth is the metric distance within the format's step.
TEST_P(StoredDepth, IsTheMetricDistanceWithinAStep) {
    const StoredCase& c = GetParam();
    const Scene scene = make_scene(make_plane(10, 10));
    Settings s = hard_settings();
    s.bias = no_bias();
    s.map.format = c.format;
    s.map.reversed_z = c.reversed;
    s.map.resolution = 256;
    LightSettings& light = s.lights[0];
    light.type = c.type;
    light.projection = c.projection;
    light.elevation = 60;
    light.distance = 20;
    if (c.ratio > 0) {
        light.fit = LightFit::Manual;
        light.far = 30;
        light.near = light.far / c.ratio;
    }
    const Shot shot = draw_shot(scene, s, 64, 48);
    const glm::dvec3 n(0, 1, 0);
    int seen = 0;
    double worst = 0, mean_steps = 0;
    for (std::size_t face = 0; face < shot.maps.size(); ++face) {
        const LightView& view = shot.view(face);
        const FloatImage& map = shot.maps[face];
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x) {
                const float stored = map.at(x, y);
                // The plane under the texel's centre; row 0 is the top of the map.
                const double u = (2 * (x + 0.5) / map.width - 1) * view.half_extent();
                const double v = (1 - 2 * (y + 0.5) / map.height) * view.half_extent();
                const glm::dvec3 aside = u * view.axes[0] + v * view.axes[1];
                const bool p = view.curve.perspective;
                const glm::dvec3 origin = p ? view.eye : view.eye + aside;
                const glm::dvec3 dir = p ? aside - view.axes[2] : -view.axes[2];
                const double z = -glm::dot(origin, n) / glm::dot(dir, n);
                const glm::dvec3 at = origin + z * dir;
                // Texels that the plane fully covers.
                if (!(z > view.curve.near && z < view.curve.far && std::abs(at.x) < 4.7 && std::abs(at.z) < 4.7))
                    continue;
                const double own = view.curve.depth(z);
                const double step = depth_quantum(s.map.format, view.curve, own);
                const ReceiverPlane plane = receiver_plane(view, at, n);
                const LeastBias parts = least_bias(plane.gradient, 0, map.width, step,
                                                   hard_renderer().driver().subpixel_bits, rounding_bias(view, at, 20));
                const double error = std::abs(stored - own);
                worst = std::max(worst, error / parts.total());
                mean_steps += error / step;
                ++seen;
                // The tolerance in metres is the step over the curve's slope, bent a little at coarse steps.
                const double metres = std::abs(view.curve.distance(stored) - z);
                ASSERT_LE(metres, 1.5 * parts.total() / view.curve.slope(z) + 1e-9) << x << ", " << y;
            }
    }
    ASSERT_GT(seen, 2000);
    EXPECT_LE(worst, 1) << "of what step, vertex snapping and float rounding allow";
    // Table of steps: a fixed-point format that hits its step loses a quarter of it on average (or half, truncating).
    if (c.format == MapFormat::D16) {
        EXPECT_GT(mean_steps / seen, 0.125);
        EXPECT_LT(mean_steps / seen, 1.0);
    }
}

INSTANTIATE_TEST_SUITE_P(All, StoredDepth, testing::ValuesIn(stored_cases()),
                         [](const auto& named) { return case_name(named.param); });

// Case 4: reversed depth in a float map keeps 2^-22 of the distance over any range; standard depth does not.
TEST(HardCase4, ReversedFloatResolvesEveryDistance) {
    for (double ratio : {1e2, 1e4, 1e6})
        for (bool reversed : {true, false}) {
            DepthCurve curve{true, 100 / ratio, 100, {true, reversed}};
            double worst = 0;
            for (int i = 1; i < 1000; ++i) {
                const double z = curve.near * std::pow(ratio, i / 1000.0);
                worst = std::max(worst, std::abs(curve.distance(float(curve.depth(z))) - z) / z);
            }
            if (reversed) {
                EXPECT_LE(worst, 0x1p-22);
            } else {
                EXPECT_GT(worst, 0x1p-22) << "standard depth must lose more, or the case proves nothing";
            }
        }
}

SI_TEST_IS(Later, HardCase4, ReversedMapsGiveTheSameShadows);
TEST(HardCase4, ReversedMapsGiveTheSameShadows) {
    const Scene scene = floor_and_box();
    for (LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (MapFormat format : kStoredFormats) {
            Settings s = hard_settings();
            s.lights[0].type = type;
            s.map.format = format;
            const Shot standard = draw_shot(scene, s);
            s.map.reversed_z = true;
            const Shot reversed = draw_shot(scene, s);
            expect_fault(4, shadow_share(standard));
            // Two roundings of one depth may fall to either side on a few boundary pixels.
            expect_within_limit(4, differing_share(standard, reversed));
            // The reversed map holds the mirrored depths: the setting acts.
            double worst = 0, largest = 0;
            for (std::size_t face = 0; face < standard.maps.size(); ++face) {
                const FloatImage &a = standard.maps[face], &b = reversed.maps[face];
                const DepthCurve& curve = standard.view(face).curve;
                for (std::size_t k = 0; k < a.data.size(); ++k) {
                    const double step = depth_quantum(format, curve, a.data[k]);
                    worst = std::max(worst, std::abs(1.0 - a.data[k] - b.data[k]) / (2.5 * step + 4 * 0x1p-23));
                    largest = std::max(largest, double(b.data[k]));
                }
            }
            EXPECT_LE(worst, 1) << format_name(format) << ", of what steps and rounding allow";
            EXPECT_GT(largest, 0.1);
        }
}

// Depths crowd near the light. Equal steps of distance still separate distant points.
TEST(HardCase4, SixteenBitsOfDistanceAreFinerFarAway) {
    const Scene scene = make_scene(make_plane(10, 10));
    Settings s = hard_settings();
    s.bias = no_bias();
    set_all(s, {"light.type=spot", "light.fit=manual", "light.elevation=60", "light.distance=20", "light.near=0.03",
                "light.far=30"});
    const auto acne = [&](MapFormat format, double texels) {
        s.map.format = format;
        s.bias.unit = BiasUnit::Texels;
        s.bias.constant = texels;
        return shadow_share(draw_shot(scene, s));
    };
    // The bias is far above the need of sampling. Steps of depth at 20 m are 0.2 m there, those of distance half a
    // millimetre.
    EXPECT_GT(acne(MapFormat::D16, 2), 0.02);
    EXPECT_EQ(acne(MapFormat::Linear16, 2), 0);
    EXPECT_EQ(acne(MapFormat::Linear, 2), 0);
    EXPECT_GT(acne(MapFormat::Linear, 0), 0.05) << "the plane must be able to shadow itself";
}

TEST(HardCase4, PolygonOffsetMovesNoDistances) {
    const Scene scene = floor_and_box();
    for (LightType type : {LightType::Directional, LightType::Spot}) {
        Settings s = hard_settings();
        s.lights[0].type = type;
        s.map.format = MapFormat::Linear;
        const Shot without = draw_shot(scene, s);
        s.bias.raster_slope = 50;
        const Shot with = draw_shot(scene, s);
        EXPECT_EQ(with.maps[0].data, without.maps[0].data);
        EXPECT_NE(idle_reason(s, *find_setting("bias.raster_slope")), "");
        EXPECT_EQ(differing_share(without, with), 0);
    }
}

/// Returns the largest change of stored depth between two maps, over texels that both drew.
double largest_change(const FloatImage& a, const FloatImage& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i)
        if (a.data[i] < 1 && b.data[i] < 1) most = std::max(most, double(b.data[i]) - a.data[i]);
    return most;
}

// Case 5: units of the polygon offset differ by format and driver. Maps must show the measured unit.
TEST(HardCase5, PolygonOffsetActsAsMeasured) {
    const Scene scene = make_scene(make_plane(10, 10));
    for (MapFormat format : {MapFormat::D16, MapFormat::D24, MapFormat::D32F, MapFormat::Colour}) {
        const PolygonOffset& offset = hard_renderer().driver().offset[std::size_t(format)];
        EXPECT_TRUE(offset.measured);
        SCOPED_TRACE(format_name(format));
        Settings s = hard_settings();
        s.bias = no_bias();
        s.map.format = format;
        set_all(s, {"light.elevation=90", "light.fit=manual", "light.distance=6", "light.near=1e-9", "light.far=10",
                    "light.extent=6"});
        LightSettings& light = s.lights[0];
        const Shot flat = draw_shot(scene, s, 64, 48);
        const double step = depth_quantum(format, 0.6);
        s.bias.raster_units = format == MapFormat::D16 ? 100 : 1000;
        const double r = largest_change(flat.maps[0], draw_shot(scene, s, 64, 48).maps[0]) / s.bias.raster_units;
        EXPECT_GE(r, 0.49 * step);
        EXPECT_LE(offset.unit(step), 1.002 * r) << "bias must not be overestimated";
        if (offset.unit_depth > 0 || format == MapFormat::D32F) {
            EXPECT_NEAR(offset.unit(step) / r, 1, 0.01);
        }
        // The factor's slope: |dz/dx| of the window for a plane that tilts along one axis of the map.
        s.bias.raster_units = 0;
        light.elevation = 60;
        light.azimuth = 0;
        const Shot tilted = draw_shot(scene, s, 64, 48);
        const ReceiverPlane plane = receiver_plane(tilted.view(), {0, 0, 0}, {0, 1, 0});
        const glm::dvec2 g = glm::abs(plane.gradient) / double(tilted.frame.map_resolution);
        s.bias.raster_slope = 20;
        const double m = largest_change(tilted.maps[0], draw_shot(scene, s, 64, 48).maps[0]) / s.bias.raster_slope;
        const double largest = std::max(g.x, g.y), length = std::sqrt(g.x * g.x + g.y * g.y);
        EXPECT_GE(m, 0.99 * largest - 2 * step);
        EXPECT_LE(m, 1.01 * length + 2 * step);
        EXPECT_NEAR(m / offset.slope(g), 1, 0.01 + 2 * step / largest);
        EXPECT_GT(largest, 20 * step) << "the slope must stand out of the steps";
    }
}

}  // namespace
}  // namespace si::test
