// What the editor says and draws of a light's cascades.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/ui/screen.h"
#include "tests/ui/ui_harness.h"
#include "ui/scene_view/light_handles.h"

namespace si::test {
namespace {

/// @param text without its spaces
bool prints(const UiHarness& ui, const std::u32string& text) {
    return ui.printed().find(text) != std::u32string::npos;
}

TEST(CascadeMarks, TheMapViewerNamesTheShownOne) {
    UiHarness ui(kWidth, kHeight);
    ui.frames(3);
    EXPECT_FALSE(prints(ui, U"cascade"));
    ui.state.settings.lights[0].cascades = 3;
    ui.state.settings.view.face = 1;
    ui.frames(3);
    EXPECT_TRUE(prints(ui, U"cascade2of3"));
    ui.state.settings.view.face = 5;
    ui.frames(3);
    EXPECT_TRUE(prints(ui, U"cascade3of3")) << "past the last is the last";
}

TEST(CascadeMarks, OfALightThatIsFittedToTheCameraOnlyTheDirectionIsMoved) {
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
