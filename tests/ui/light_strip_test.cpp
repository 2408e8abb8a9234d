// Tests of the strip along a light's path: requests, a drag that sets the light, and a measurement in a real editor.
#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

/// Path of three points with made-up errors, the second the worst.
LightPathResult made_up_path() {
    LightPathResult r;
    r.path = straight_path("light.azimuth=0:80,light.elevation=20:40", 3, Settings{});
    for (const double mae : {0.01, 0.03, 0.02}) {
        r.steps.push_back({.point = r.path.points[r.steps.size()]});
        r.steps.back().error.mae = mae;
    }
    return r;
}

TEST(LightStrip, PositionsOnThePathAreThoseOfTheLight) {
    const LightPathResult r = made_up_path();
    Settings s;
    for (const double position : {0.0, 0.25, 0.5, 0.8, 1.0}) {
        set_strip_position(r, position, s);
        EXPECT_NEAR(s.lights[0].azimuth, 80 * position, 1e-9);
        EXPECT_NEAR(s.lights[0].elevation, 20 + 20 * position, 1e-9);
        ASSERT_TRUE(strip_position(r, s));
        EXPECT_NEAR(*strip_position(r, s), position, 1e-9);
    }
    set_strip_position(r, 7, s);
    EXPECT_EQ(s.lights[0].azimuth, 80) << "the end of the path";
    s.lights[0].elevation = 70;
    EXPECT_FALSE(strip_position(r, s)) << "off the path";
}

class LightStripTest : public ::testing::Test {
protected:
    UiHarness ui{1900, 1000};

    void SetUp() override {
        ui.state.window.open_page = Page::LightPath;
        ui.state.layout.bottom_height = 32;
        ui.frames(4);
    }
};

TEST_F(LightStripTest, ButtonsRequestBothKindsOfPaths) {
    ui.state.light_strip.azimuth_from = -10;
    ui.state.light_strip.steps = 7;
    std::optional<EditorRequests> asked;
    const auto press = [&] {
        const auto at = ui.find("/light-path_", "", "Measure the path");
        ASSERT_TRUE(at);
        ui.move(*at);
        ui.frames(2);
        asked = ui.click_here();
    };
    press();
    ASSERT_TRUE(asked->measure_along);
    EXPECT_EQ(*asked->measure_along, "light.azimuth=-10:90,light.elevation=30:30");
    EXPECT_EQ(asked->path_steps, 7);
    ui.state.light_strip.day = true;
    ui.frames(2);
    press();
    EXPECT_FALSE(asked->measure_along);
    EXPECT_EQ(asked->measure_day, "48,172");
    ui.light_strip.measuring_path = SearchProgress{"light.azimuth=3", 0.4};
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"40%", "light.azimuth=3"}), "");
}

TEST_F(LightStripTest, ADragSetsTheLightAndTheWorstStepIsSaved) {
    const LightPathResult result = made_up_path();
    ui.light_strip.path = &result;
    ui.light_strip.path_current = true;
    ui.frames(3);
    const auto plot = ui.find("/light-path_", "", "path plot");
    ASSERT_TRUE(plot);
    const double before = ui.state.settings.lights[0].azimuth;
    ui.drag(*plot, {float(ui.width()) * 0.9f, plot->y});
    EXPECT_NE(ui.state.settings.lights[0].azimuth, before);
    EXPECT_GT(ui.state.settings.lights[0].azimuth, 40);
    EXPECT_TRUE(strip_position(result, ui.state.settings));
    ui.click(ui.find("/light-path_", "", "Go to the worst"));
    ui.frames(2);
    EXPECT_EQ(ui.state.settings.lights[0].azimuth, 40);
    EXPECT_EQ(ui.state.settings.lights[0].elevation, 30);
    ui.state.settings.lights[0].azimuth = 3;
    ui.click(ui.find("/light-path_", "", "Save the worst…"));
    ui.frames(3);
    EXPECT_EQ(ui.state.settings.lights[0].azimuth, 40);
    EXPECT_EQ(ui.state.files.dialog.job, FileDialog::Job::SavePreset);
    EXPECT_NE(ui.state.files.dialog.about.find("largest error"), std::string::npos);
}

SI_TEST_IS(Later, EditorLightStrip, MeasuresInTheBackground);
TEST(EditorLightStrip, MeasuresInTheBackground) {
    TestEditor editor;
    EditorRequests request = editor.requests();
    request.measure_along = "light.azimuth=10:50";
    request.path_steps = 2;
    const Settings settings = editor.state().settings;
    editor.model().fulfil(request);
    EXPECT_TRUE(editor.facts().measuring_path);
    editor.settle();
    EXPECT_EQ(editor.state().settings, settings);
    const EditorFrame facts = editor.facts();
    ASSERT_TRUE(facts.path);
    ASSERT_EQ(facts.path->steps.size(), 2u);
    EXPECT_GT(facts.path->steps[1].error.counted, 100u);
    EXPECT_TRUE(facts.path_current);
    set_strip_position(*facts.path, 0.5, editor.state().settings);
    editor.settle();
    EXPECT_TRUE(editor.facts().path_current) << "the light's direction does not matter";
    editor.state().settings.map.resolution = 64;
    editor.settle();
    EXPECT_FALSE(editor.facts().path_current);
    request.measure_along = "light.azimuth=10";
    editor.model().fulfil(request);
    EXPECT_NE(editor.last_line().find("KEY=from:to"), std::string::npos);
}

}  // namespace
}  // namespace si::test
