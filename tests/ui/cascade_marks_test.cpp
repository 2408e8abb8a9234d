// Tests of cascade names and marks in the editor.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/ui/screen.h"
#include "tests/ui/ui_harness.h"
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

}  // namespace
}  // namespace si::test
