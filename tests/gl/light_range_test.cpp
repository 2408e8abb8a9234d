// Tests light.range, the window of KHR_lights_punctual: picture, probe and measured error.
#include <cmath>

#include "renderer/measure/measured_error.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/ray_reference.h"
#include "tests/support/traits.h"

namespace si {
namespace {

constexpr double kLightHeight = 2;  // height of the light over the floor, metres

double linear(std::uint8_t srgb) {
    const double c = srgb / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

class LightRange : public FrameTest {
protected:
    Scene scene = make_floor();

    static Scene make_floor() {
        Scene s;
        const int white = add_material(s, "white", {1, 1, 1});
        add_object(s, "floor", -1, add_mesh(s, "floor", make_plane(10, 10), white));
        finalise(s);
        return s;
    }
    Settings lit(const char* type, double range) {
        return settings_for(scene, {{"light.type", type},
                                    "light.elevation=90",
                                    {"light.distance", std::to_string(kLightHeight)},
                                    "light.cone=140",
                                    "light.cone_blend=0",
                                    {"light.range", std::to_string(range)},
                                    "shading.ambient=0",
                                    "shading.diffuse=1",
                                    "shading.specular=0",
                                    "shading.sky=plain",
                                    "shading.curve=plain"});
    }
};

TEST_F(LightRange, LightFadesByTheWindowAndEnds) {
    const double range = 3;
    const FrameRequest request = small_request();
    for (const char* type : {"spot", "point"})
        for (const char* path : {"true", "false"}) {
            Settings s = lit(type, 0);
            set_setting(s, "shading.separate_visibility", path);
            const ByteImage endless = picture(scene, s);
            set_setting(s, "light.range", std::to_string(range));
            const ByteImage ended = picture(scene, s);
            const FrameResult frame = renderer.render(scene, s, request);
            std::size_t dark = 0, half = 0;
            for (const auto& [x, y, origin, direction] :
                 test::pixel_rays(frame.camera, request.width, request.height)) {
                const glm::dvec3 p = origin - direction * (origin.y / direction.y);
                const std::size_t i = (std::size_t(y) * std::size_t(request.width) + std::size_t(x)) * 4;
                if (direction.y >= 0 || std::abs(p.x) > 4.9 || std::abs(p.z) > 4.9) continue;
                const double d = std::hypot(p.x, p.z, kLightHeight), share = d / range;
                const double before = linear(endless.data[i]), after = linear(ended.data[i]);
                if (d > 1.01 * range) {
                    EXPECT_EQ(ended.data[i], 0) << type << " at " << x << ',' << y;
                    dark += endless.data[i] > 0;
                } else if (before > 0.02) {
                    const double window = std::max(1 - std::pow(share, 4), 0.0);
                    // Both values are rounded to steps of 1/255, the steepest of which is 0.0091 in linear light.
                    EXPECT_NEAR(after, before * window, 0.0091) << type << " at " << x << ',' << y;
                    half += share > 0.7 && share < 0.85;
                }
            }
            EXPECT_GT(dark, 500u) << type;
            EXPECT_GT(half, 500u) << type;
        }
}

TEST_F(LightRange, AtHalfTheRangeFifteenSixteenthsAreLeft) {
    Settings s = lit("point", 0);
    set_all(s, {"camera.source=manual", "camera.elevation=89.9"});
    const FrameRequest request{.width = 65, .height = 65};
    const auto middle = [&] { return linear(picture(scene, s, request).data[(32 * 65 + 32) * 4]); };
    set_setting(s, "light.intensity", "1");
    const double before = middle();
    ASSERT_NEAR(before, 1, 0.01) << "straight under the light, which is normalised to 1 there";
    set_setting(s, "light.range", std::to_string(2 * kLightHeight));
    EXPECT_NEAR(middle(), before * 15 / 16, 0.005);
    set_setting(s, "light.range", std::to_string(0.99 * kLightHeight));
    EXPECT_EQ(middle(), 0);
}

SI_TEST_IS(Repeated, LightRange, ProbeReportsPointsOutOfRange);
TEST_F(LightRange, ProbeReportsPointsOutOfRange) {
    const Settings s = lit("point", 3);
    int beyond = 0, within = 0;
    for (int y = 20; y < 180; y += 10)
        for (int x = 10; x < 320; x += 20) {
            const Probe p = renderer.probe(scene, s, small_request(), x, y);
            if (!p.hit) continue;
            const bool reached = glm::distance(p.position_ws, glm::dvec3(0, kLightHeight, 0)) < 3;
            EXPECT_EQ(p.lights.at(0).verdict.find("beyond the light's range of 3 m") == std::string::npos, reached)
                << p.lights[0].verdict;
            ++(reached ? within : beyond);
        }
    EXPECT_GT(beyond, 10);
    EXPECT_GT(within, 5);
}

TEST_F(LightRange, PointsOutOfRangeAreNotMeasured) {
    Settings s = lit("point", 3);
    ReferenceCache cache;
    const MeasuredError error = measure_error(renderer, scene, s, small_request(), 0, {}, cache);
    const std::size_t beyond = error.metrics.pixels[std::size_t(PixelState::BeyondRange)];
    EXPECT_GT(beyond, 1000u);
    EXPECT_GT(error.metrics.counted, 1000u);
    EXPECT_EQ(error.metrics.false_shadow, 0);
    set_all(s, {"map.outside=unlit", "light.near=0.1", "light.far=1.9", "light.fit=manual"});
    const MeasuredError cut = measure_error(renderer, scene, s, small_request(), 0, {}, cache);
    EXPECT_EQ(cut.metrics.counted, error.metrics.counted);
    EXPECT_GT(cut.metrics.outside_false_shadow, 0) << "the map ends before the light does";
    set_setting(s, "light.range", "0");
    const MeasuredError endless = measure_error(renderer, scene, s, small_request(), 0, {}, cache);
    EXPECT_EQ(endless.metrics.counted, error.metrics.counted + beyond) << "another range needs another reference";
}

}  // namespace
}  // namespace si
