// Tests the account of polygon offset units against the depths that the driver stores, for every format.
#include "renderer/scenes/shapes.h"
#include "renderer/settings/map_storage.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using RasterOffset = FrameTest;

SI_TEST_IS(Later, RasterOffset, UnitsAreThoseOfTheTrianglesGreatestDepth);
TEST_F(RasterOffset, UnitsAreThoseOfTheTrianglesGreatestDepth) {
    // Depths of each of the floor's two triangles span nearly the whole range.
    const Scene scene = test::grey_scene({{"floor", make_plane(10, 10)}});
    for (const char* format : {"d16", "d24", "d32f", "colour"})
        for (const bool reversed : {false, true}) {
            SCOPED_TRACE(testing::Message() << format << (reversed ? " reversed" : ""));
            Settings s = settings_with(test::texel_settings("hard", 256, 0),
                                       {"light.azimuth=20", "light.elevation=30", {"map.format", format}});
            s.map.reversed_z = reversed;
            s.camera = orbiting_camera({0, 0, 0}, 0, 89, 12);
            const double units = s.map.format == MapFormat::D16 ? 60 : 20000;
            s.bias.raster_units = units;
            const FloatImage slack = overlay_values(scene, s, "bias-slack");
            int finer = 0;
            for (const glm::ivec2 pixel : {glm::ivec2(160, 90), {120, 40}, {200, 140}, {170, 30}, {150, 150}}) {
                s.bias.raster_units = 0;
                const Probe plain = renderer.probe(scene, s, small_request(), pixel.x, pixel.y);
                s.bias.raster_units = units;
                const Probe moved = renderer.probe(scene, s, small_request(), pixel.x, pixel.y);
                ASSERT_TRUE(plain.hit && moved.hit);
                const Probe::PerLight &a = plain.lights.at(0), &b = moved.lights.at(0);
                const double offset = (reversed ? -1 : 1) * (b.stored - a.stored);
                const double step = depth_quantum(s.map.format, std::max(a.stored, b.stored));
                EXPECT_NEAR(b.account.raster, offset, 0.01 * offset + 2 * step) << pixel.x << "," << pixel.y;
                const BiasBreakdown& account = b.account;
                const double expected =
                    account.amount(account.equivalent_depth()).texels - account.amount(account.least.total()).texels;
                EXPECT_NEAR(slack.at(pixel.x, pixel.y), expected, 0.01 * std::abs(expected) + 0.01) << "GLSL";
                EXPECT_NEAR(b.evidence.equivalent_bias, account.equivalent_depth(),
                            0.01 * account.equivalent_depth() + step);
                finer += depth_quantum(s.map.format, a.own) * 1.9 * units < offset;
            }
            // Otherwise the pixel's own step would do.
            if (s.map.format == MapFormat::D32F) {
                EXPECT_GT(finer, 0);
            }
        }
}

TEST_F(RasterOffset, ChangesOfItKeepTheUnfilteredMap) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = test::texel_settings("hard", 256, 0);
    FrameRequest request = small_request();
    request.outputs.unfiltered_map = true;
    const auto state = [&] { return renderer.render(scene, s, request).pass("unfiltered map")->state; };
    s.bias.raster_units = 100;
    EXPECT_EQ(state(), PassState::Drawn);
    s.bias.raster_units = 200;
    s.bias.raster_slope = 2;
    const FrameResult moved = renderer.render(scene, s, request);
    EXPECT_EQ(moved.pass("unfiltered map")->state, PassState::Cached);
    EXPECT_EQ(moved.pass("shadow map 0 (directional)")->state, PassState::Drawn) << "polygon offset moves its depths";
    s.map.resolution = 128;
    EXPECT_EQ(state(), PassState::Drawn);
    s.lights[0].azimuth += 20;
    EXPECT_EQ(state(), PassState::Drawn);
    s.caster.cull = Cull::Front;
    EXPECT_EQ(state(), PassState::Drawn);
}

}  // namespace
}  // namespace si
