// Tests of the lab: sliders, requests of buttons, displayed results, and both measurements in a real editor.
#include <gtest/gtest.h>

#include "app/base/output.h"
#include "renderer/settings/overlays.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

class LabPanelTest : public ::testing::Test {
protected:
    UiHarness ui{1900, 1000};

    void SetUp() override {
        ui.state.window.open_page = Page::Lab;
        ui.state.layout.bottom_height = 32;
        ui.frames(4);
        ASSERT_TRUE(ui.state.shows(Page::Lab));
    }
};

TEST_F(LabPanelTest, ShowsMeasurements) {
    PipelineError e{.origin = MapOrigin::World, .transform = MapTransform::Eye, .pixels = 10};
    e.texels = {.median = 12.5, .p99 = 46.25, .worst = 99, .worst_at = {1, 2}};
    e.ulps = {.median = 577, .p99 = 2700, .worst = 9999, .worst_at = {1, 2}};
    e.flips = 4711;
    const std::vector<PipelineError> errors{e};
    std::vector<ShimmerShown> shimmer{{"Stabilised, unsnapped", {}}};
    shimmer[0].shimmer.flips_a_step = 96.125;
    shimmer[0].shimmer.flipping_pixels = 357;
    shimmer[0].shimmer.places = 40514;
    ui.lab.pipelines = errors;
    ui.lab.shimmer = shimmer;
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"12.5", "46.2", "577", "4711", "the world's origin, from the eye", "96.1", "357", "40514",
                          "Of other settings"}),
              "");
}

TEST_F(LabPanelTest, ButtonsRequestMeasurements) {
    ui.state.lab.shimmer = {.motion = ShimmerMotion::LightTurns, .steps = 5, .step_texels = 0.5};
    ui.frames(2);
    ui.click(ui.find("ways", "", "Compare precision"));
    EXPECT_TRUE(ui.last_requests.compare_pipelines);
    ui.click(ui.find("crawling", "", "Measure shimmer"));
    ASSERT_TRUE(ui.last_requests.measure_shimmer);
    EXPECT_EQ(ui.last_requests.measure_shimmer->motion, ShimmerMotion::LightTurns);
    EXPECT_EQ(ui.last_requests.measure_shimmer->steps, 5);
    ui.lab.measuring_shimmer = SearchProgress{"As set", 0.4};
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"40%"}), "");
}

SI_TEST_IS(Later, EditorLab, MeasuresInTheBackgroundAndChangesNothing);
TEST(EditorLab, MeasuresInTheBackgroundAndChangesNothing) {
    TestEditor editor;
    EditorModel& model = editor.model();
    model.state.window.open_page = Page::Lab;
    model.state.layout.bottom_height = 27;
    editor.settle();
    EditorRequests request = editor.requests();
    request.compare_pipelines = true;
    request.measure_shimmer = ShimmerOptions{.steps = 2};
    const Settings settings = model.state.settings;
    model.fulfil(request);
    EXPECT_TRUE(model.facts().comparing_pipelines);
    editor.settle();
    EXPECT_EQ(model.state.settings, settings);
    ASSERT_EQ(model.facts().pipelines.size(), 4u);
    EXPECT_TRUE(model.facts().pipelines_current);
    ASSERT_EQ(model.facts().shimmer.size(), 3u);
    EXPECT_TRUE(model.facts().shimmer_current);
    EXPECT_GT(model.facts().shimmer[0].shimmer.places, 100u);
    editor.frames(3);
    write_png(std::filesystem::path(SI_TEST_OUTPUT_DIR) / "lab_panel.png", editor.picture());
    model.state.settings.scene.distance = 1e6;
    editor.settle();
    EXPECT_FALSE(model.facts().pipelines_current) << "the scene is elsewhere now";
    EXPECT_FALSE(model.facts().shimmer_current);
}

}  // namespace
}  // namespace si::test
