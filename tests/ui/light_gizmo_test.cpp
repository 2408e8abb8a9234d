// Tests of light handles and light marks under a synthetic mouse, in the whole editor.
#include <gtest/gtest.h>
#include <imgui.h>

#include "renderer/view/fits/light_fit.h"
#include "tests/support/traits.h"
#include "tests/ui/screen.h"
#include "tests/ui/ui_harness.h"
#include "ui/scene_view/light_drag.h"
#include "ui/scene_view/light_marks.h"

namespace si::test {
namespace {

/// Editor whose camera shows all of the light and its frustum.
struct Gizmo {
    UiHarness ui{kWidth, kHeight};
    Settings& settings = ui.state.settings;
    LightSettings& light = settings.lights[0];

    explicit Gizmo(LightType type) {
        settings.camera.source = CameraSource::Manual;
        settings.camera.distance = 4 * ui.scene.bounds.radius();
        settings.camera.azimuth = 10;
        light.type = type;
        light.elevation = 40;
        light.distance = ui.scene.bounds.radius();
        ui.frames(3);
        ui.state.history.reset(settings);
    }
    const PictureView& view() const { return *ui.state.viewport.view; }
    LightPose pose(int i = 0) const {
        return light_pose(settings.lights[std::size_t(i)], fit_lights(ui.scene, settings)[std::size_t(i)], 0);
    }
    std::vector<PlacedHandle> handles() const { return place_handles(pose(), view()); }
    glm::vec2 place(LightHandle h) const {
        for (const PlacedHandle& p : handles())
            if (p.handle == h) return p.on_screen;
        ADD_FAILURE() << "no handle " << handle_name(h);
        return {};
    }
    void key(int index, bool down) { ImGui::GetIO().KeysDown[ImGui::GetKeyIndex(index)] = down; }
};

SI_TEST_IS(Later, LightGizmo, EveryHandleChangesTheLightInOneUndoStep);
TEST(LightGizmo, EveryHandleChangesTheLightInOneUndoStep) {
    int dragged = 0;
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (const PlacedHandle& handle : Gizmo(type).handles()) {
            Gizmo g(type);
            const Settings before = g.settings;
            const glm::vec2 at = g.place(handle.handle);
            g.ui.drag(at, at + glm::vec2(14, -11));
            EXPECT_NE(g.light, before.lights[0]) << handle_name(handle.handle) << " of type " << int(type);
            EXPECT_EQ(g.settings.camera, before.camera) << "the camera turned with the " << handle_name(handle.handle);
            EXPECT_FALSE(g.ui.state.probe_pixel);
            ASSERT_TRUE(g.ui.state.history.can_undo());
            EXPECT_EQ(g.ui.state.history.undo(), before) << "more than one step";
            EXPECT_FALSE(g.ui.state.history.can_undo());
            ++dragged;
        }
    EXPECT_GT(dragged, 18);
}

/// Counts the vertices that the editor draws in the next frame.
int drawn_vertices(UiHarness& ui) {
    ui.frames(2);
    return ImGui::GetDrawData()->TotalVtxCount;
}

TEST(LightGizmo, AppearsNearTheMouseUnlessTheLookIsPlain) {
    Gizmo g(LightType::Spot);
    g.ui.state.window.open_page = Page::Improve;  // the list of lights is out of sight
    g.ui.frames(3);
    g.ui.state.viewport.hovered_light.reset();
    const glm::vec2 at = g.place(LightHandle::Far);
    const glm::vec2 away(g.view().origin + glm::dvec2(4, g.view().size.y - 4));
    g.ui.move(away);
    const int hidden = drawn_vertices(g.ui);
    g.ui.move(at + glm::vec2(60, 0));
    EXPECT_FALSE(g.ui.state.viewport.hovered_light);
    EXPECT_GT(drawn_vertices(g.ui), hidden + 50) << "near";
    g.ui.move(away);
    EXPECT_NEAR(drawn_vertices(g.ui), hidden, 8);
    g.settings.view.look = Look::Plain;
    EXPECT_GT(drawn_vertices(g.ui), hidden + 50) << "plain: always";
    g.ui.key('L');
    EXPECT_FALSE(g.settings.view.frustum);
    EXPECT_NEAR(drawn_vertices(g.ui), hidden, 40);
}

TEST(LightGizmo, ClickOnAHandleChangesNothing) {
    Gizmo g(LightType::Spot);
    const Settings before = g.settings;
    for (const LightHandle h : {LightHandle::Near, LightHandle::Target, LightHandle::ConeTop}) g.ui.click(g.place(h));
    EXPECT_EQ(g.settings, before);
    EXPECT_FALSE(g.ui.state.probe_pixel);
}

TEST(LightGizmo, EscapeRestoresAndEndsTheDrag) {
    Gizmo g(LightType::Directional);
    const Settings before = g.settings;
    const glm::vec2 at = g.place(LightHandle::Direction);
    g.ui.move(at);
    g.ui.frames(2);
    g.ui.press(true);
    g.ui.frame();
    g.ui.move(at + glm::vec2(30, 12));
    g.ui.frames(2);
    EXPECT_NE(g.light.azimuth, before.lights[0].azimuth);
    g.key(ImGuiKey_Escape, true);
    g.ui.frame();
    g.key(ImGuiKey_Escape, false);
    EXPECT_EQ(g.settings, before);
    g.ui.move(at + glm::vec2(60, 40));
    g.ui.frames(2);
    EXPECT_EQ(g.settings, before) << "the mouse is still down";
    g.ui.press(false);
    g.ui.frames(2);
    EXPECT_EQ(g.settings, before);
    EXPECT_FALSE(g.ui.state.history.can_undo());
    EXPECT_FALSE(g.ui.state.probe_pixel);
}

TEST(LightGizmo, HandleIsHitWithinNinePixels) {
    Gizmo g(LightType::Spot);
    const glm::vec2 at = g.place(LightHandle::Far);
    for (const glm::vec2 off : {glm::vec2(9, 0), glm::vec2(0, -9), glm::vec2(-6, 6)}) {
        g.ui.move(at + off);
        g.ui.frames(2);
        ASSERT_TRUE(g.ui.state.viewport.hovered_light);
        EXPECT_EQ(g.ui.state.viewport.hovered_light->handle, LightHandle::Far);
    }
    g.ui.move(at + glm::vec2(14, 0));
    g.ui.frames(2);
    EXPECT_FALSE(g.ui.state.viewport.hovered_light);
    g.ui.click(at);
    g.ui.move(at + glm::vec2(3, 0));
    g.ui.frames(2);
    EXPECT_TRUE(g.ui.state.viewport.hovered_light) << "and again after a click";
}

TEST(LightGizmo, HandleGrabbedOffCentreDoesNotJump) {
    LightSettings moved[2];
    for (const int off : {0, 1}) {
        Gizmo g(LightType::Spot);
        const glm::vec2 at = g.place(LightHandle::Far) + float(off) * glm::vec2(-5, 4);
        g.ui.drag(at, at + glm::vec2(22, 13));
        moved[off] = g.light;
    }
    EXPECT_NE(moved[0], LightSettings{});
    EXPECT_NEAR(moved[0].far, moved[1].far, 1e-6);
}

TEST(LightGizmo, ArrowToALightOutsideThePictureBringsItIn) {
    Gizmo g(LightType::Spot);
    g.light.distance = 9 * g.ui.scene.bounds.radius();
    g.light.elevation = 75;
    g.ui.frames(3);
    const auto arrow = pointer_place(g.pose(), g.view());
    ASSERT_TRUE(arrow) << "the light is in the picture";
    const LightSettings before = g.light;
    g.ui.click(glm::vec2(*arrow));
    EXPECT_FALSE(pointer_place(g.pose(), g.view())) << "still outside";
    EXPECT_EQ(g.light, before);
    EXPECT_FALSE(g.ui.state.probe_pixel) << "the click probed as well";
}

TEST(LightGizmo, OnlyLightsOfSettingsAndFrameAreShown) {
    Gizmo g(LightType::Spot);
    g.settings.light_count = 2;
    g.settings.lights[1].type = LightType::Point;
    g.settings.lights[1].azimuth = 120;
    g.settings.lights[1].distance = g.light.distance;
    g.ui.frames(2);
    g.ui.move(*g.view().point(g.pose(1).position));
    g.ui.frames(2);
    ASSERT_TRUE(g.ui.state.viewport.hovered_light);
    EXPECT_EQ(g.ui.state.viewport.hovered_light->light, 1);
    g.ui.frame_settings = g.settings;  // the previous frame
    g.settings.light_count = 1;
    g.ui.frames(2);
    EXPECT_FALSE(g.ui.state.viewport.hovered_light) << "of a light that is gone";
    g.ui.frame_settings->light_count = 1;
    g.settings.light_count = 2;
    g.settings.view.light = 1;
    g.ui.frames(2);
    EXPECT_FALSE(g.ui.state.viewport.hovered_light) << "of a light that was not drawn yet";
}

TEST(LightGizmo, ControlSnapsToSteps) {
    Gizmo g(LightType::Directional);
    g.light.azimuth = -31.7;
    g.ui.frames(2);
    const glm::vec2 at = g.place(LightHandle::Direction);
    const CameraSettings camera = g.settings.camera;
    ImGui::GetIO().KeyCtrl = true;
    g.ui.drag(at, at + glm::vec2(25, 9));
    ImGui::GetIO().KeyCtrl = false;
    EXPECT_NE(g.light.azimuth, -31.7);
    EXPECT_EQ(std::remainder(g.light.azimuth, 5), 0);
    EXPECT_EQ(std::remainder(g.light.elevation, 5), 0);
    EXPECT_EQ(g.settings.camera, camera);
}

TEST(LightGizmo, MarkSelectsAnotherLight) {
    Gizmo g(LightType::Spot);
    g.settings.light_count = 3;
    g.settings.lights[2].type = LightType::Point;
    g.settings.lights[2].azimuth = 120;
    g.settings.lights[2].distance = g.light.distance;
    g.ui.frames(3);
    const auto mark = g.view().point(g.pose(2).position);
    ASSERT_TRUE(mark && g.view().contains(*mark));
    const CameraSettings camera = g.settings.camera;
    g.ui.click(glm::vec2(*mark));
    EXPECT_EQ(g.settings.view.light, 2);
    EXPECT_FALSE(g.ui.state.probe_pixel) << "the click probed as well";
    g.ui.drag(*mark, glm::vec2(*mark) + glm::vec2(20, 5));
    EXPECT_EQ(g.settings.camera, camera);
    EXPECT_NE(g.settings.lights[2].azimuth, 120) << "its handles act once it is chosen";
}

TEST(LightGizmo, HiddenFrustumHasNoHandles) {
    Gizmo g(LightType::Spot);
    const glm::vec2 at = g.place(LightHandle::Far);
    g.settings.view.frustum = false;
    g.ui.frames(2);
    const LightSettings before = g.light;
    const CameraSettings camera = g.settings.camera;
    g.ui.drag(at, at + glm::vec2(20, 5));
    EXPECT_EQ(g.light, before);
    EXPECT_NE(g.settings.camera, camera) << "the camera turns instead";
}

TEST(LightGizmo, LightHasNoHandlesInItsOwnView) {
    Gizmo g(LightType::Spot);
    g.settings.camera.source = CameraSource::Light;
    g.ui.frames(3);
    const Settings before = g.settings;
    const PictureView& v = g.view();
    for (double x = 5; x < v.size.x; x += 25)
        for (double y = 5; y < v.size.y; y += 25) {
            g.ui.move(v.origin + glm::dvec2(x, y));
            g.ui.frame();
            EXPECT_FALSE(g.ui.state.viewport.hovered_light) << x << ", " << y;
        }
    EXPECT_EQ(g.settings, before);
}

TEST(LightGizmo, LightMayDisappearDuringADrag) {
    Gizmo g(LightType::Spot);
    const glm::vec2 at = g.place(LightHandle::Far);
    g.ui.move(at);
    g.ui.frames(2);
    g.ui.press(true);
    g.ui.frame();
    g.settings.light_count = 0;
    g.ui.move(at + glm::vec2(20, 5));
    g.ui.frames(2);
    g.ui.press(false);
    g.ui.frames(2);
    EXPECT_FALSE(g.ui.state.viewport.handle_drag);
}

}  // namespace
}  // namespace si::test
