// Tests of flying, framing, freezing and selecting objects in the whole editor by synthetic mouse and keys.
#include <gtest/gtest.h>
#include <imgui.h>

#include "renderer/view/cameras/make_camera.h"
#include "tests/ui/screen.h"
#include "tests/ui/ui_harness.h"
#include "ui/state/selection.h"

namespace si::test {
namespace {

constexpr glm::vec2 kPicture{200, 250};

struct Viewport {
    UiHarness ui{kWidth, kHeight};
    Settings& settings = ui.state.settings;

    Viewport() {
        settings.view.frustum = false;  // no handle in the way
        ui.frames(3);
        ui.state.history.reset(settings);
    }
    Camera camera() const { return make_camera(ui.scene, ui.state.settings, 1.5); }
    void hold(char key, bool down) { ImGui::GetIO().KeysDown[int(key)] = down; }
    void press(char key) { ui.key(key); }
    /// Holds the right button and W for a time in a number of frames.
    glm::dvec3 flown(double seconds, int frames, bool shift = false) {
        const glm::dvec3 before = camera().eye;
        ui.move(kPicture);
        ui.frames(2);
        ui.press(true, 1);
        ui.frame();
        hold('W', true);
        ImGui::GetIO().KeyShift = shift;
        ui.frame_seconds = seconds / frames;
        ui.frames(frames + 1);  // the first frame finds the key and does not move yet
        hold('W', false);
        ImGui::GetIO().KeyShift = false;
        ui.frames(1);
        ui.press(false, 1);
        ui.frames(2);
        return camera().eye - before;
    }
};

TEST(Viewport, FlightDistanceIsIndependentOfFrameRate) {
    glm::dvec3 way(0);
    for (const int frames : {4, 60}) {
        Viewport v;
        const Camera before = v.camera();
        const glm::dvec3 moved = v.flown(1, frames);
        EXPECT_NEAR(glm::dot(glm::normalize(moved), -before.axes[2]), 1, 1e-6) << "forwards";
        if (frames == 4)
            way = moved;
        else
            EXPECT_NEAR(glm::distance(moved, way), 0, 1e-6 * glm::length(way));
        ASSERT_TRUE(v.ui.state.history.can_undo());
        EXPECT_EQ(v.ui.state.history.undo().camera, CameraSettings{});
        EXPECT_FALSE(v.ui.state.history.can_undo()) << "more than one step";
    }
}

TEST(Viewport, ShiftAndTheWheelFlyFaster) {
    Viewport v;
    const double slow = glm::length(v.flown(0.5, 10)), fast = glm::length(v.flown(0.5, 10, true));
    EXPECT_NEAR(fast / slow, 4, 1e-6);
    v.ui.press(true, 1);
    v.ui.frame();
    ImGui::GetIO().MouseWheel = 2;
    v.ui.frame();
    v.ui.press(false, 1);
    v.ui.frames(2);
    EXPECT_NEAR(glm::length(v.flown(0.5, 10)) / slow, 1.25 * 1.25, 1e-6);
}

TEST(Viewport, EditorRedrawsWhileAKeyIsHeldAndThenSleeps) {
    Viewport v;
    v.ui.move(kPicture);
    v.ui.frames(2);
    v.ui.press(true, 1);
    v.ui.frame();
    v.hold('D', true);
    EXPECT_TRUE(v.ui.frame().redraw);
    EXPECT_TRUE(v.ui.frame().redraw);
    v.hold('D', false);
    EXPECT_FALSE(v.ui.frame().redraw);
    v.ui.press(false, 1);
    EXPECT_FALSE(v.ui.frames(2).redraw);
}

TEST(Viewport, MouseIsCapturedInFlightAndLinksAreReadAtRest) {
    Viewport v;
    v.ui.move(kPicture);
    EditorRequests requests = v.ui.frames(2);
    EXPECT_FALSE(requests.hold_cursor);
    EXPECT_TRUE(requests.want_links && requests.want_overlay_values);
    for (const int button : {0, 1}) {
        v.ui.press(true, button);
        EXPECT_FALSE(v.ui.frames(2).hold_cursor) << "a click lets it be";
        v.ui.move(kPicture + glm::vec2(25, 10));
        requests = v.ui.frames(2);
        EXPECT_EQ(requests.hold_cursor, button == 1) << "orbiting ends at the screen's edges as any drag";
        EXPECT_FALSE(requests.want_links || requests.want_overlay_values) << "read back in every frame of a drag";
        v.ui.press(false, button);
        requests = v.ui.frames(2);
        EXPECT_FALSE(requests.hold_cursor);
        EXPECT_TRUE(requests.want_links);
        v.ui.move(kPicture);
    }
}

TEST(Viewport, FlightKeysNeedTheMouseButton) {
    Viewport v;
    const Settings before = v.settings;
    v.ui.move(kPicture);
    for (const char key : {'W', 'A', 'S', 'D', 'Q', 'E'}) v.press(key);
    EXPECT_EQ(v.settings, before);
}

TEST(Viewport, RightButtonLooksAround) {
    Viewport v;
    const Camera before = v.camera();
    v.ui.drag(kPicture, kPicture + glm::vec2(50, 10), 1);
    const Camera after = v.camera();
    EXPECT_NEAR(glm::distance(after.eye, before.eye), 0, 1e-6);
    EXPECT_GT(glm::dot(-after.axes[2], before.axes[0]), 0.05);
}

TEST(Viewport, LettersInFlightAreNoShortcuts) {
    Viewport v;
    v.ui.move(kPicture);
    v.ui.frames(2);
    v.ui.press(true, 1);
    v.ui.frames(2);
    const MapView map = v.settings.view.map;
    v.press('M');
    EXPECT_EQ(v.settings.view.map, map);
    v.ui.press(false, 1);
    v.ui.frames(2);
    v.press('M');
    EXPECT_NE(v.settings.view.map, map);
}

TEST(Viewport, DoubleClickSelectsTheProbedObjectAndFFramesIt) {
    Viewport v;
    v.press('F');
    const double all = v.settings.camera.distance;
    v.ui.probed_object = v.ui.scene.nodes[std::size_t(v.ui.scene.objects.back().node)].path;
    v.ui.click(kPicture);
    EXPECT_TRUE(v.ui.state.selection.first.empty()) << "one click only probes";
    v.ui.click(kPicture);
    v.ui.frames(2);
    EXPECT_EQ(v.ui.state.selection.first, v.ui.probed_object);
    v.press('F');
    const Bounds b = bounds_of(v.ui.scene, v.ui.probed_object);
    EXPECT_LT(v.settings.camera.distance, all);
    EXPECT_NEAR(v.settings.camera.target_x, b.centre().x, 1e-9);
    const auto escape = ImGui::GetKeyIndex(ImGuiKey_Escape);
    for (const bool chosen : {true, false}) {  // the probe has priority
        v.ui.key(escape);
        EXPECT_FALSE(v.ui.state.probe_pixel);
        EXPECT_EQ(!v.ui.state.selection.first.empty(), chosen);
    }
}

TEST(Viewport, ShiftLLooksThroughTheLightAndBack) {
    Viewport v;
    ImGui::GetIO().KeyShift = true;
    v.settings.camera.source = CameraSource::Manual;
    v.settings.camera.azimuth = 77;
    const CameraSettings before = v.settings.camera;
    v.press('L');
    EXPECT_EQ(v.settings.camera.source, CameraSource::Light);
    v.press('L');
    EXPECT_EQ(v.settings.camera, before);
    v.settings.camera.source = CameraSource::Light;  // a preset may have it
    v.press('L');
    EXPECT_NE(v.settings.camera.source, CameraSource::Light);
    v.settings.light_count = 0;
    const CameraSettings last = v.settings.camera;
    v.press('L');
    EXPECT_EQ(v.settings.camera, last) << "there is no light to look through";
}

TEST(Viewport, FreezeKeepsThePreviousCamera) {
    Viewport v;
    const Camera before = v.camera();
    v.press('K');
    ASSERT_TRUE(v.ui.state.frozen);
    v.ui.drag(kPicture, kPicture + glm::vec2(60, 25));
    EXPECT_NEAR(glm::distance(v.ui.state.frozen->camera.eye, before.eye), 0, 1e-9);
    EXPECT_GT(glm::distance(v.camera().eye, before.eye), 1e-3);
    v.press('K');
    EXPECT_FALSE(v.ui.state.frozen);
    v.ui.state.layout.map_place = MapSpot::Hidden;  // the row has space for the button
    v.ui.frames(2);
    v.ui.click(v.ui.find("editor/scene", "", "Freeze view"));
    EXPECT_TRUE(v.ui.state.frozen);
    EXPECT_NE(v.settings.camera.source, CameraSource::Light) << "another button was hit";
}

TEST(Viewport, ClickOnAnAxisLooksAlongIt) {
    Viewport v;
    v.settings.camera.source = CameraSource::Manual;
    v.ui.frames(2);
    const PictureView view = *v.ui.state.viewport.view;
    ASSERT_GT(v.ui.state.viewport.covered, 0) << "the strip is open";
    const glm::vec2 corner = glm::vec2(view.origin + view.size) - glm::vec2(0, v.ui.state.viewport.covered);
    int found = 0;
    for (float y = 0; y < 80; y += 4)
        for (float x = 0; x < 80; x += 4) {
            v.ui.move(corner - glm::vec2(x, y));
            v.ui.frame();
            if (v.ui.state.viewport.hovered_axis != 'y') continue;
            v.ui.click(corner - glm::vec2(x, y));
            EXPECT_NEAR(std::abs(v.settings.camera.elevation), 90, 1e-9);
            EXPECT_FALSE(v.ui.state.probe_pixel);
            v.settings.camera.elevation = 25;
            v.ui.frames(2);
            ++found;
        }
    EXPECT_GT(found, 3);
}

TEST(Viewport, EveryMarkIsDrawnWithoutComplaint) {
    Viewport v;
    v.settings.view.frustum = v.settings.view.bounds = true;
    v.settings.light_count = 4;
    v.settings.lights[1].type = LightType::Spot;
    v.settings.lights[2].type = LightType::Point;
    v.settings.lights[3].type = LightType::Spot;
    v.settings.lights[3].projection = LightProjection::Orthographic;
    v.ui.state.selection.first = v.ui.scene.nodes[std::size_t(v.ui.scene.objects[0].node)].path;
    v.ui.state.frozen = FrozenCamera{v.camera(), camera_settings(v.camera()), {640, 360}};
    v.ui.state.probe_pixel = glm::ivec2(20, 30);
    for (const bool orthographic : {false, true})
        for (int light = 0; light < 4; ++light)
            for (const double distance : {0.01, 3.0, 500.0}) {
                v.settings.camera = manual_camera(v.ui.scene, v.settings);
                v.settings.camera.orthographic = orthographic;
                v.settings.camera.distance = v.settings.camera.height = distance;
                v.settings.view.light = light;
                v.ui.frames(2);
                const ImDrawData& data = *ImGui::GetDrawData();
                for (int i = 0; i < data.CmdListsCount; ++i)
                    for (const ImDrawVert& vertex : data.CmdLists[i]->VtxBuffer)
                        ASSERT_TRUE(std::abs(vertex.pos.x) < 1e5f && std::abs(vertex.pos.y) < 1e5f)
                            << vertex.pos.x << ", " << vertex.pos.y << " light " << light << " distance " << distance;
            }
}

}  // namespace
}  // namespace si::test
