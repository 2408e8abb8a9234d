// Tests the map viewer: shown shadow maps, shown camera depth, and their read-back.
#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/base/error.h"
#include "renderer/frame/depth_histogram.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class MapViewTest : public FrameTest {
protected:
    FrameResult frame(const Scene& scene, const Settings& s) {
        FrameRequest request = small_request({.colour = false, .shadow_map = true});
        return renderer.render(scene, s, request);
    }
    int grey(const ByteImage& image, int x, int y) {
        return image.data[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4];
    }
};

SI_TEST_IS(Repeated, MapViewTest, ShowsTheCamerasOwnDepth);
TEST_F(MapViewTest, ShowsTheCamerasOwnDepth) {
    const Scene scene = load_scene("boxes");
    for (const char* orthographic : {"false", "true"})
        for (const char* reversed_map : {"false", "true"}) {  // must not affect the camera
            Settings s = settings_for(scene, {"camera.source=manual",
                                              "camera.distance=9",
                                              {"camera.orthographic", orthographic},
                                              {"map.reversed_z", reversed_map},
                                              "view.map_source=camera",
                                              "view.map=linear"});
            const FrameResult f = frame(scene, s);
            EXPECT_EQ(f.map_view_size, glm::ivec2(320, 180));
            EXPECT_EQ(f.map_view_curve.perspective, orthographic == std::string("false"));
            EXPECT_EQ(f.map_view_curve.near, f.camera.curve.near);
            EXPECT_TRUE(f.map_view_curve.convention.reversed);
            const FloatImage depth = renderer.read_map_view_depth(f);
            const ByteImage shown = renderer.read_colour(f.map_view);
            ASSERT_EQ(depth.width, 320);
            ASSERT_EQ(depth.height, 180);
            int surfaces = 0;
            for (int y = 4; y < 180; y += 23)
                for (int x = 2; x < 320; x += 29) {
                    const Probe p = renderer.probe(scene, s, small_request(), x, y);
                    if (!p.hit) {
                        EXPECT_EQ(depth.at(x, y), 0) << "nothing drawn";
                        EXPECT_LT(grey(shown, x, y), 45) << "hatched, as dark as no surface here";
                        continue;
                    }
                    ++surfaces;
                    const double z = glm::dot(f.camera.axes[2], f.camera.eye - p.position_ws);
                    EXPECT_NEAR(f.map_view_curve.distance(double(depth.at(x, y))), z, 1e-4 * z);
                    const double share = (z - f.map_view_curve.near) / (f.map_view_curve.far - f.map_view_curve.near);
                    EXPECT_NEAR(grey(shown, x, y), 255 * share, 1.01);
                }
            EXPECT_GT(surfaces, 30);
        }
}

TEST_F(MapViewTest, NearAndFarPlanesCutSharply) {
    // A floor reaches from behind the camera past the far plane, seen nearly level.
    const Scene scene = load_scene("boxes");
    for (const auto& [near, far] : {std::pair{"1", "8"}, {"1", "7.5"}, {"3", "5"}}) {
        const Settings s = settings_for(scene, {"camera.source=manual",
                                                "camera.distance=6",
                                                "camera.elevation=12",
                                                {"camera.near", near},
                                                {"camera.far", far},
                                                "view.map_source=camera"});
        const FrameResult f = frame(scene, s);
        EXPECT_EQ(f.map_view_curve.near, std::stod(near));
        EXPECT_EQ(f.map_view_curve.far, std::stod(far));
        const DepthStatistics d = depth_statistics(renderer.read_map_view_depth(f), f.map_view_curve);
        EXPECT_GT(d.empty, 100u);
        EXPECT_GE(d.metres_min, f.map_view_curve.near - 1e-6);
        EXPECT_LE(d.metres_max, f.map_view_curve.far + 1e-6);
        EXPECT_GT(d.metres_max, f.map_view_curve.far - 0.4) << "a row of pixels spans that much of the floor";
        EXPECT_EQ(near == std::string("3"), d.metres_min > 2.5);
    }
}

TEST_F(MapViewTest, FitsGreysToTheDrawnDepths) {
    const Scene scene = load_scene("boxes");
    for (const char* source : {"light", "camera"})
        for (const char* type : {"directional", "spot", "point"})
            for (const char* view : {"raw", "linear"})
                for (const char* reversed : {"false", "true"}) {
                    const Settings s = settings_for(scene, {{"view.map_source", source},
                                                            {"light.type", type},
                                                            {"view.map", view},
                                                            {"map.reversed_z", reversed},
                                                            "map.resolution=200",
                                                            "view.face=3",
                                                            "view.map_fit=true"});
                    const FrameResult f = frame(scene, s);
                    const FloatImage depth = renderer.read_map_view_depth(f);
                    const DepthStatistics d = depth_statistics(depth, f.map_view_curve);
                    const bool raw = view == std::string("raw");
                    const std::string where = std::string(source) + " " + type + " " + view + " " + reversed;
                    ASSERT_GT(d.drawn, 500u) << where;
                    EXPECT_NEAR(f.map_black, raw ? d.stored_min : d.linear_min, 1e-6) << where;
                    EXPECT_NEAR(f.map_white, raw ? d.stored_max : d.linear_max, 1e-6) << where;
                    const ByteImage shown = renderer.read_colour(f.map_view);
                    for (int y = 0; y < depth.height; y += 13)
                        for (int x = 0; x < depth.width; x += 11) {
                            if (depth.at(x, y) == f.map_view_curve.convention.far_depth()) {
                                EXPECT_LT(grey(shown, x, y), 45) << where << ": nothing was drawn";
                                continue;
                            }
                            const double value = shown_depth(double(depth.at(x, y)), f.map_view_curve, s.view.map,
                                                             map_v_of_row(depth, y));
                            const double t = (value - f.map_black) / (f.map_white - f.map_black);
                            // Near the far plane of a perspective map one float step is a visible distance.
                            const double step = raw ? 1e-7 / (f.map_white - f.map_black) : 1e-4;
                            EXPECT_NEAR(grey(shown, x, y), 255 * std::clamp(t, 0.0, 1.0), 1.01 + 255 * step) << where;
                        }
                }
}

// A plane under slanted light covers the whole range of depths.
TEST_F(MapViewTest, RampsFollowDepth) {
    const Scene scene = load_scene("boxes");
    Settings s = settings_for(scene, {"map.resolution=128", "view.map_fit=true"});
    const FrameResult grey_frame = frame(scene, s);
    const ByteImage greys = renderer.read_colour(grey_frame.map_view);
    for (const char* ramp : {"turbo", "viridis"}) {
        set_setting(s, "view.map_colours", ramp);
        const ByteImage shown = renderer.read_colour(frame(scene, s).map_view);
        std::map<int, glm::ivec3> of_grey;  // one colour per depth
        for (std::size_t i = 0; i < shown.data.size(); i += 4) {
            if (greys.data[i] != greys.data[i + 2]) continue;  // hatched pixels are bluish
            const glm::ivec3 colour(shown.data[i], shown.data[i + 1], shown.data[i + 2]);
            const glm::ivec3 known = of_grey.emplace(greys.data[i], colour).first->second;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(known[c], colour[c], 16) << ramp;  // within one grey level
        }
        ASSERT_GT(of_grey.size(), 50u);
        const glm::ivec3 low = of_grey.begin()->second, high = of_grey.rbegin()->second;
        if (ramp == std::string("viridis")) {
            EXPECT_GT(low.z, low.y) << "violet";
            EXPECT_GT(high.y, high.z + 100) << "yellow";
        } else {
            EXPECT_GT(high.x, high.z + 50) << "red";
        }
    }
}

TEST_F(MapViewTest, ManualGreysAreReturned) {
    const Scene scene = load_scene("boxes");
    const FrameResult f = frame(scene, settings_for(scene, {"view.map_black=0.25", "view.map_white=0.5"}));
    EXPECT_EQ(f.map_black, 0.25f);
    EXPECT_EQ(f.map_white, 0.5f);
    EXPECT_EQ(f.map_view_size, glm::ivec2(f.map_resolution));
}

TEST_F(MapViewTest, ANumberAfterTheLastMapShowsTheLastAndIsReported) {
    const Scene scene = load_scene("boxes");
    const auto noted = [&](const char* type, const char* cascades, const char* face) {
        const FrameResult f = frame(
            scene, settings_for(scene, {{"light.type", type}, {"light.cascades", cascades}, {"view.face", face}}));
        std::string text;
        for (const std::string& note : f.notes)
            if (note.starts_with("view.face")) text += note;
        return text;
    };
    EXPECT_EQ(noted("directional", "3", "5"),
              "view.face 5: light 0 has maps 0 to 2; the last is shown, cascade 3 of 3");
    EXPECT_EQ(noted("directional", "3", "2"), "");
    EXPECT_EQ(noted("point", "1", "5"), "");
    EXPECT_EQ(noted("directional", "1", "5"), "") << "without effect there";
}

TEST_F(MapViewTest, ReadBackGivesTheShownMap) {
    const Scene scene = load_scene("boxes");
    const Settings s = settings_for(scene, {"light.type=point", "light.count=2", "view.light=0", "view.face=3"});
    const FrameResult f = frame(scene, s);
    EXPECT_EQ(renderer.read_map_view_depth(f).data, renderer.read_shadow_map(f, 0, 3).data);
    EXPECT_NE(renderer.read_map_view_depth(f).data, renderer.read_shadow_map(f, 0, 2).data);
    EXPECT_EQ(f.map_view_curve.far, f.lights[0].views[3].curve.far);
    FrameRequest closed = small_request();
    EXPECT_THROW(renderer.read_map_view_depth(renderer.render(scene, s, closed)), Error);
}

}  // namespace
}  // namespace si
