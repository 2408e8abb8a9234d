// Tests frames of different scenes and settings that are read and probed in turn: each answers for itself, or reports
// that its images are gone.
#include "renderer/base/error.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/error_text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

struct ShownFrame {
    Scene scene;
    Settings settings;
    FrameRequest request;
};

class FrameReadability : public FrameTest {
protected:
    /// Returns two frames that share nothing: scene, number and types of lights, formats, sizes and camera differ.
    std::vector<ShownFrame> two_frames() {
        std::vector<ShownFrame> out;
        Scene boxes = load_scene("boxes"), plane = load_scene("stage");
        out.push_back({std::move(boxes), {}, {.width = 160, .height = 120}});
        out.push_back({std::move(plane), {}, {.width = 200, .height = 90}});
        out[0].settings = settings_for(out[0].scene, {"map.resolution=64", "light.count=2", "light.1.type=point",
                                                      "light.1.distance=6", "view.light=1", "view.face=3"});
        out[1].settings =
            settings_for(out[1].scene, {"map.resolution=96", "map.format=d16", "light.azimuth=90",
                                        "view.map_source=camera", "bias.kind=constant", "bias.constant=3"});
        for (ShownFrame& s : out) s.request.outputs.shadow_map = true;
        return out;
    }
    FrameResult draw(const ShownFrame& s) { return renderer.render(s.scene, s.settings, s.request); }
};

SI_TESTS_ARE(DriverIndependent, FrameReadability);
TEST_F(FrameReadability, FramesAreReadableUntilReplacedAndThenRefused) {
    const std::vector<ShownFrame> both = two_frames();
    std::vector<FloatImage> maps, views;
    for (const ShownFrame& s : both) {  // each by a new renderer
        Renderer fresh;
        const FrameResult f = fresh.render(s.scene, s.settings, s.request);
        maps.push_back(fresh.read_shadow_map(f, 0, 0));
        views.push_back(fresh.read_map_view_depth(f));
        EXPECT_FALSE(renderer.has_images_of(f)) << "of another renderer";
        EXPECT_THROW(renderer.read_shadow_map(f, 0, 0), Error);
    }
    ASSERT_NE(maps[0].data.size(), maps[1].data.size());
    std::vector<FrameResult> last(2);
    for (int turn = 0; turn < 6; ++turn) {
        const auto now = std::size_t(turn % 2), other = 1 - now;
        const FrameResult f = draw(both[now]);
        EXPECT_TRUE(renderer.has_images_of(f));
        EXPECT_EQ(renderer.read_shadow_map(f, 0, 0).data, maps[now].data) << turn;
        EXPECT_EQ(renderer.read_map_view_depth(f).data, views[now].data) << turn;
        if (turn > 0) {
            EXPECT_FALSE(renderer.has_images_of(last[other])) << turn;
            EXPECT_TRUE(test::fails_with([&] { renderer.read_shadow_map(last[other], 0, 0); },
                                         {"shadow maps of this frame were overwritten"}));
            EXPECT_TRUE(test::fails_with([&] { renderer.read_map_view_depth(last[other]); }, {"draw it again"}));
        }
        last[now] = f;
    }
}

TEST_F(FrameReadability, AFrameThatDrawsNothingKeepsTheOtherReadable) {
    const std::vector<ShownFrame> both = two_frames();
    const FrameResult f = draw(both[0]), again = draw(both[0]);
    EXPECT_TRUE(renderer.has_images_of(f)) << "all was reused";
    EXPECT_TRUE(renderer.has_images_of(again));
    ShownFrame less = both[0];
    less.request.outputs = {.colour = false, .surface_ids = true};
    const FrameResult ids = draw(less);
    EXPECT_TRUE(renderer.has_images_of(f)) << "other images of the same view";
    EXPECT_TRUE(test::fails_with([&] { renderer.read_shadow_map(ids, 0, 0); }, {"did not draw"}));
    EXPECT_EQ(renderer.read_shadow_map(f, 0, 0).data, renderer.read_shadow_map(again, 0, 0).data);
    less.request.width += 8;  // changes the picture's aspect, and so the camera's depth range
    less.request.outputs.colour = true;
    draw(less);
    EXPECT_FALSE(renderer.has_images_of(f));
    EXPECT_NO_THROW(renderer.read_shadow_map(f, 0, 0)) << "the maps are the same";
}

TEST_F(FrameReadability, AlternatingProbesAnswerForTheirOwnFrame) {
    const std::vector<ShownFrame> both = two_frames();
    const glm::ivec2 pixel{90, 60};
    std::vector<Probe> alone;
    for (const ShownFrame& s : both) {
        Renderer fresh;
        alone.push_back(fresh.probe(s.scene, s.settings, s.request, pixel.x, pixel.y));
        ASSERT_TRUE(alone.back().hit);
    }
    ASSERT_NE(alone[0].lights.size(), alone[1].lights.size());
    ASSERT_GT(glm::length(alone[0].position_ws - alone[1].position_ws), 0.01);
    for (int turn = 0; turn < 4; ++turn) {
        const auto now = std::size_t(turn % 2);
        const ShownFrame& s = both[now];
        const FrameResult f = draw(s);
        const FloatImage before = renderer.read_map_view_depth(f);
        const Probe p = renderer.probe(s.scene, s.settings, s.request, pixel.x, pixel.y);
        EXPECT_EQ(p.position_ws, alone[now].position_ws);
        ASSERT_EQ(p.lights.size(), alone[now].lights.size());
        for (std::size_t i = 0; i < p.lights.size(); ++i) {
            const Probe::PerLight &a = p.lights[i], &b = alone[now].lights[i];
            EXPECT_EQ(a.visibility, b.visibility) << i;
            ASSERT_EQ(a.taps.size(), b.taps.size()) << i;
            for (std::size_t t = 0; t < a.taps.size(); ++t) {
                EXPECT_EQ(a.taps[t].texel, b.taps[t].texel);
                EXPECT_EQ(a.taps[t].stored, b.taps[t].stored);
            }
        }
        EXPECT_TRUE(renderer.has_images_of(f)) << "a probe leaves what is shown as it is";
        EXPECT_EQ(renderer.read_map_view_depth(f).data, before.data);
    }
}

SI_TEST_IS(Repeated, FrameReadability, AProbeKeepsTheShownFrame);
SI_TEST_IS(Product, FrameReadability, AProbeKeepsTheShownFrame);
SI_TEST_IS(Slow, FrameReadability, AProbeKeepsTheShownFrame);
// Otherwise a window that shows both frames would draw forever.
TEST_F(FrameReadability, AProbeKeepsTheShownFrame) {
    const std::vector<Sets> all = {
        {},
        {"filter.kernel=evsm4", "view.map_channel=moment-2"},
        {"filter.kernel=pcss", "map.virtual=true"},
        {"light.cascades=3", "bias.raster_slope=2", "view.panes=four"},
        {"light.type=point", "light.contact=0.2"},
        {"light.source=volumes-zfail", "view.overlay=depth-difference"},
        {"light.source=blob"},
        {"light.cast=false"},
        {"view.slabs=both", "view.slabs_u=0.5", "view.slabs_v=0.5", "view.map_source=camera"},
    };
    using Ask = bool Outputs::*;
    const std::vector<std::vector<Ask>> asks = {{},
                                                {&Outputs::health},
                                                {&Outputs::visibility, &Outputs::shadow_map, &Outputs::health,
                                                 &Outputs::texels_read, &Outputs::map_coordinates, &Outputs::overlay}};
    const Scene scene = load_scene("stage");
    for (const Sets& sets : all) {
        Settings s = settings_for(scene, {"map.resolution=128"});
        std::string what;
        for (const auto& [key, value] : sets) {
            set_setting(s, key, value);
            what += key + "=" + value + " ";
        }
        for (const auto& ask : test::portion(asks, 2)) {
            FrameRequest request{.width = 96, .height = 64};
            for (const Ask a : ask) request.outputs.*a = true;
            int drawn = 0;
            for (bool held = false; !held && drawn < 5; ++drawn) {
                const FrameResult shown = renderer.render(scene, s, request);
                renderer.probe(scene, s, request, 48, 40);
                held = renderer.has_images_of(shown);
            }
            EXPECT_LE(drawn, 2) << what << "and " << ask.size() << " outputs";  // the probe needs whole maps
        }
    }
}

TEST_F(FrameReadability, AFrameWithReleasedImagesIsRefused) {
    std::vector<ShownFrame> frames(4, two_frames()[0]);
    set_setting(frames[0].settings, "filter.kernel", "vsm");
    set_setting(frames[1].settings, "map.blur_texels", "2");
    set_all(frames[2].settings, {"light.source=volumes-zfail", "light.1.source=volumes-zfail"});
    set_all(frames[3].settings, {"view.panes=two", "view.overlay=normals"});
    for (const ShownFrame& drawn : frames) {
        const FrameResult f = draw(drawn);
        EXPECT_TRUE(renderer.has_images_of(f));
        ShownFrame plain = two_frames()[0];
        set_setting(plain.settings, "light.azimuth", "33");
        draw(plain);
        EXPECT_FALSE(renderer.has_images_of(f));
        EXPECT_THROW(renderer.read_shadow_map(f, 1, 0), Error);
    }
}

}  // namespace
}  // namespace si
