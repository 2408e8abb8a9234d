// Tests of cascade names and marks in the editor.
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>

#include "renderer/base/lengths_text.h"
#include "renderer/settings/overlays.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/ui/screen.h"
#include "tests/ui/ui_harness.h"
#include "ui/scene_view/cascade_bar.h"
#include "ui/scene_view/light_handles.h"
#include "ui/state/scene_choices.h"

namespace si::test {
namespace {

TEST(CascadeMarks, MapViewerNamesTheShownCascade) {
    UiHarness ui(kWidth, kHeight);
    ui.frames(3);
    EXPECT_FALSE(ui.prints("cascade"));
    ui.state.settings.lights[0].cascades = 3;
    ui.state.settings.view.face = 1;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"cascade 2 of 3"}), "");
    ui.state.settings.view.face = 5;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"cascade 3 of 3"}), "") << "past the last is the last";
}

// Views are listed among the maps of the shown light, in every place of the choice.
TEST(CascadeMarks, OnlyExistingViewsAreListedByName) {
    UiHarness ui(kWidth, kHeight);
    Settings& s = ui.state.settings;
    const Camera camera = make_camera(ui.scene, s, 1.5);
    const auto names = [&] {
        FrameResult result;
        result.lights = fit_lights(ui.scene, s, &camera);
        std::vector<std::string> out;
        for (const auto& [value, name] : view_choices(s, &result, "view.face")) {
            EXPECT_EQ(value, value < int(result.lights[0].views.size()) ? int(out.size()) : s.view.face);
            out.push_back(name);
        }
        EXPECT_TRUE(view_choices(s, &result, "view.light").empty());
        return out;
    };
    EXPECT_TRUE(names().empty()) << "a single map";
    s.lights[0].cascades = 2;
    EXPECT_EQ(names(), (std::vector<std::string>{"cascade 1 of 2", "cascade 2 of 2"}));
    s.view.face = 4;
    EXPECT_EQ(names(), (std::vector<std::string>{"cascade 1 of 2", "cascade 2 of 2", "cascade 2 of 2"}));
    s.lights[0].type = LightType::Point;
    EXPECT_EQ(names(), (std::vector<std::string>{"face +x", "face -x", "face +y", "face -y", "face +z", "face -z"}));
    EXPECT_TRUE(view_choices(s, nullptr, "view.face").empty());
    // The settings list the same views.
    s.view.face = 0;
    const auto printed = [&] {
        ui.frames(4);
        std::size_t count = 0;
        for (std::size_t at = 0; (at = ui.printed().find(U"face+x", at)) != std::u32string::npos; ++at) ++count;
        return count;
    };
    const std::size_t in_map_viewer = printed();
    EXPECT_GT(in_map_viewer, 0u);
    ui.state.settings_panel.search = "view.face";
    EXPECT_EQ(printed(), in_map_viewer + 1);
}

TEST(CascadeMarks, OnlyTheDirectionOfACameraFittedLightMoves) {
    UiHarness ui(kWidth, kHeight);
    Settings& s = ui.state.settings;
    const auto pose = [&] {
        const Camera camera = make_camera(ui.scene, s, 1.5);
        return light_pose(s.lights[0], fit_lights(ui.scene, s, &camera)[0], 0);
    };
    EXPECT_FALSE(pose().cascaded());
    EXPECT_GT(handles_of(pose()).size(), 5u);
    s.lights[0].cascades = 4;
    EXPECT_EQ(pose().cascades.size(), 4u) << "whose frusta are drawn";
    EXPECT_EQ(handles_of(pose()), std::vector<LightHandle>{LightHandle::Direction});
}

/// Shows the overlay of cascades for a light with four.
void show_cascades(UiHarness& ui) {
    const auto all = overlays();
    const auto row = std::ranges::find_if(all, [](const Overlay& o) { return o.names_views; });
    ui.state.settings.view.overlay = int(row - all.begin()) + 1;
    ui.state.settings.lights[0].cascades = 4;
    ui.frames(4);
}

std::vector<double> cascade_ends(const Scene& scene, const Settings& settings) {
    const Camera camera = make_camera(scene, settings, 1.5);
    const std::vector<FittedLight> lights = fit_lights(scene, settings, &camera);
    std::vector<double> ends;
    for (const ViewSpan& span : lights[0].chooser.spans) ends.push_back(span.ends);
    return ends;
}

TEST(CascadeBar, LegendNamesEachCascadesRangeAndTexels) {
    UiHarness ui(1600, 900);
    show_cascades(ui);
    const std::vector<double> ends = cascade_ends(ui.scene, ui.state.settings);
    ASSERT_EQ(ends.size(), 4u);
    EXPECT_EQ(ui.lacking({"cascade 1: to " + metres_text(ends[0]), "cascade 4: ", metres_text(ends[3]), "a texel"}),
              "");
}

TEST(CascadeBar, MovedEndIsWhereItWasDraggedAndOthersStay) {
    UiHarness ui(1280, 720);
    Settings& s = ui.state.settings;
    s.lights[0].cascades = 4;
    for (int cascade = 0; cascade < 3; ++cascade)
        for (int step = 0; step < 4; ++step) {
            const std::vector<double> before = cascade_ends(ui.scene, s);
            const double wanted = 0.6 * before[std::size_t(cascade)] + 0.4 * before[std::size_t(cascade) + 1];
            move_cascade_end(s.lights[0], LightSettings(s.lights[0]), before, cascade, wanted);
            const std::vector<double> after = cascade_ends(ui.scene, s);
            EXPECT_EQ(s.lights[0].split, Split::Manual);
            EXPECT_NEAR(after[std::size_t(cascade)], wanted, 1e-6 * wanted);
            for (int other = 0; other < 4; ++other)
                if (other != cascade) {
                    EXPECT_NEAR(after[std::size_t(other)], before[std::size_t(other)], 1e-6 * before.back()) << other;
                }
        }
    // Neighbours bound the move.
    const std::vector<double> ends = cascade_ends(ui.scene, s);
    move_cascade_end(s.lights[0], LightSettings(s.lights[0]), ends, 1, 1e9);
    const std::vector<double> pushed = cascade_ends(ui.scene, s);
    EXPECT_LT(pushed[1], pushed[2]);
}

TEST(CascadeBar, IsDraggedInThePictureAsOneStepOfUndo) {
    UiHarness ui(1600, 900);
    show_cascades(ui);
    ImGuiWindow* const bar = UiHarness::window("cascade bar_");
    ASSERT_TRUE(bar);
    const Settings before = ui.state.settings;
    const auto end = ui.find("cascade bar_", [](ImGuiID window) {
        const int cascade = 1;
        return ImHashStr("end", 0, ImHashData(&cascade, sizeof cascade, window));
    });
    ASSERT_TRUE(end);
    ui.drag(*end, *end + glm::vec2(20, 0));
    EXPECT_EQ(ui.state.settings.lights[0].split, Split::Manual);
    EXPECT_FALSE(ui.state.probe_pixel) << "the picture below is not clicked";
    EXPECT_EQ(ui.state.settings.camera, before.camera);
    ui.frames(2);
    EXPECT_EQ(ui.state.history.undo(), before);
    ui.state.settings.lights[0].cascades = 1;
    ui.frames(3);
    EXPECT_FALSE(UiHarness::window("cascade bar_")) << "there is nothing to divide";
}

}  // namespace
}  // namespace si::test
