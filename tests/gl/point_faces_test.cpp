// Tests the guard of a point light's six faces: with it map.wrap has no effect, without it seams show.
#include "app/session/session.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/idle_reason.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"

namespace si {
namespace {

class PointFaces : public FrameTest {
protected:
    const Scene scene = test::grey_scene({{"floor", make_plane(12, 12)}});

    Settings lamp(const Sets& extra) {
        Settings s = settings_with(test::texel_settings("pcf9", 128, 8),
                                   joined({"light.type=point", "light.distance=2", "light.elevation=90",
                                           "map.outside=unlit", "map.compare=lequal"},
                                          extra));
        s.camera = orbiting_camera({0, 0, 0}, 0, 89, 14);
        return s;
    }
    std::string idle(const Settings& s, const char* key) { return std::string(idle_reason(s, *find_setting(key))); }
};

TEST_F(PointFaces, HideAddressingBehindTheirGuard) {
    const FloatImage border = visibility(scene, lamp({"map.wrap=border"}));
    EXPECT_NE(idle(lamp({}), "map.wrap").find("set map.face_guard off"), std::string::npos);
    for (const char* wrap : {"clamp", "repeat", "range"})
        EXPECT_EQ(differing_values(border, visibility(scene, lamp({{"map.wrap", wrap}}))), 0u) << wrap;
}

TEST_F(PointFaces, ShowSeamsWithoutTheirGuard) {
    const Settings open = lamp({"map.wrap=border", "map.face_guard=false"});
    EXPECT_EQ(idle(open, "map.wrap"), "");
    EXPECT_EQ(idle(open, "map.face_guard"), "");
    const FloatImage guarded = visibility(scene, lamp({"map.wrap=border"}));
    const FloatImage seams = visibility(scene, open);
    EXPECT_GT(differing_values(guarded, seams, 0.05f), 200u) << "dark seams where taps leave a face";
    EXPECT_GT(differing_values(seams, visibility(scene, lamp({"map.wrap=repeat", "map.face_guard=false"})), 0.05f),
              100u);
}

TEST_F(PointFaces, SessionsNoteSettingsWithoutEffect) {
    const auto notes = [](const Sets& sets) {
        SessionOptions options{.scene = "boxes"};
        for (const auto& [key, value] : sets) options.sets.push_back(key + "=" + value);
        return open_session(options).notes;
    };
    EXPECT_TRUE(notes({"map.wrap=clamp", "light.cascades=4"}).empty());
    EXPECT_TRUE(notes({"light.type=point", "map.wrap=border"}).empty()) << "its default";
    const auto wrap = notes({"light.type=point", "map.wrap=clamp"});
    ASSERT_EQ(wrap.size(), 1u);
    EXPECT_TRUE(wrap[0].starts_with("map.wrap: without effect")) << wrap[0];
    const auto cascades = notes({"light.fit=manual", "light.cascades=4"});
    ASSERT_EQ(cascades.size(), 1u);
    EXPECT_TRUE(cascades[0].starts_with("light.cascades: without effect")) << cascades[0];
}

TEST_F(PointFaces, TheGuardIsOfLightsWithFacesAlone) {
    Settings sun;
    EXPECT_NE(idle(sun, "map.face_guard"), "");
    EXPECT_EQ(idle(sun, "map.wrap"), "");
}

}  // namespace
}  // namespace si
