// Tests overlays of triangle edges and of overdraw.
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"

namespace si {
namespace {

class GeometryOverlays : public FrameTest {
protected:
    /// Makes a floor of 4 x 4 m with a plate of 2 x 2 m above and one beneath, seen from 5 m straight above.
    static Scene plates() {
        return test::grey_scene({{"Floor", make_plane(4, 4)},
                                 {"Above", make_plane(2, 2), moved(0, 1, 0)},
                                 {"Below", make_plane(1, 1), moved(0, -1, 0)}});
    }
    FloatImage values(const Scene& scene, const char* overlay) {
        const Settings s = settings_for(scene, {"camera.source=manual", "camera.orthographic=true", "camera.height=5",
                                                "camera.elevation=90", "camera.azimuth=0"});
        return overlay_values(scene, s, overlay, {.width = 100, .height = 100});
    }
};

TEST_F(GeometryOverlays, OverdrawCountsEveryLayer) {
    const FloatImage v = values(plates(), "overdraw");
    // 20 pixels a metre, the middle at 50: three layers in the middle, hidden ones counted, none outside the floor.
    EXPECT_EQ(v.at(52, 47), 3);
    EXPECT_EQ(v.at(65, 50), 2);
    EXPECT_EQ(v.at(80, 50), 1);
    EXPECT_EQ(v.at(95, 50), 0);
    EXPECT_EQ(v.at(95, 50, 3), 0) << "no value there";
}

TEST_F(GeometryOverlays, WireframeDrawsVisibleEdges) {
    const FloatImage v = values(plates(), "wireframe");
    const auto drawn_near = [&](int x, int y) {
        bool any = false;
        for (int d = -1; d <= 1; ++d) any |= v.at(x + d, y, 3) > 0;
        return any;
    };
    EXPECT_TRUE(drawn_near(90, 63)) << "the floor's edge";
    EXPECT_TRUE(drawn_near(70, 63)) << "the upper plate's edge";
    EXPECT_FALSE(drawn_near(60, 57)) << "the lower plate's edge is hidden";
    EXPECT_FALSE(drawn_near(80, 50)) << "inside of a triangle";
    EXPECT_FALSE(drawn_near(96, 50));
}

TEST_F(GeometryOverlays, ChangeNothingInLaterPasses) {
    const Scene scene = load_scene("boxes");
    const ByteImage before = picture(scene, settings_for(scene));
    for (const char* overlay : {"wireframe", "overdraw"}) {
        picture(scene, settings_for(scene, {{"view.overlay", overlay}}));
        FrameRequest again = small_request();
        again.force = true;
        EXPECT_EQ(before, picture(scene, settings_for(scene), again)) << overlay;
        // The overlay's depth exists even if no other part of the picture is drawn.
        {
            HeadlessContext fresh_context;
            Renderer fresh;
            FrameRequest values_only = small_request({.colour = false, .overlay = true});
            const Settings s = settings_for(scene, {{"view.overlay", overlay}});
            const FloatImage alone = fresh.read_float(fresh.render(scene, s, values_only).overlay, 4);
            const FrameRequest both{.width = 320, .height = 180, .outputs = {.overlay = true}, .force = true};
            EXPECT_EQ(alone.data, fresh.read_float(fresh.render(scene, s, both).overlay, 4).data) << overlay;
            EXPECT_EQ(fresh.read_colour(fresh.render(scene, settings_for(scene), small_request()).colour), before)
                << overlay;
        }
        context.make_current();
    }
}

}  // namespace
}  // namespace si
