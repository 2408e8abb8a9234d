// Tests of the panel Improve: requests of its buttons, displayed figures, and undo of applied advice.
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <filesystem>

#include "app/base/output.h"
#include "renderer/advise/autopilot.h"
#include "renderer/advise/waste.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

AdviceReport made_up_advice() {
    AdviceReport r;
    Trial t;
    t.candidate.name = "nothing is seen of it";
    t.changes = {{"filter.kernel", "hard"}, {"map.resolution", "512"}};
    t.before.error = 0.01;
    t.after.error = 0.0125;
    t.ms = CostChange{-3.25, 0.5};
    r.holds = {t};
    t.candidate.name = "this was hoped";
    t.why_not = "the error grows";
    r.fails = {t};
    r.findings = {{Severity::Error, "acne everywhere", "more bias", {{"bias.normal", "7"}}}};
    r.before.error = 0.01;
    r.time.total_ms.median = 12;
    return r;
}

class ImprovePanelTest : public ::testing::Test {
protected:
    UiHarness ui{1600, 900};
    AdviceReport report = made_up_advice();

    void SetUp() override {
        ui.state.layout.map_place = MapSpot::Hidden;
        ui.state.layout.settings_width = 40;
        aim(ImproveMode::Cheaper);
        ASSERT_TRUE(ui.state.shows(Page::Improve));
    }
    void aim(ImproveMode mode) {
        open_improve(ui.state, mode);
        ui.frames(4);
    }
};

TEST_F(ImprovePanelTest, RequestsAdviceAndTheAutopilotWithItsBounds) {
    ui.click(ui.find("found", "", "Advice"));
    ASSERT_TRUE(ui.last_requests.find_advice);
    EXPECT_FALSE(ui.last_requests.find_advice->max_error);
    EXPECT_EQ(ui.last_requests.find_advice->cost, CostCase::Camera);
    aim(ImproveMode::Limits);
    ui.state.improve.max_error = 0.02;
    ui.state.improve.bound_ms = true;
    ui.state.improve.max_ms = 5;
    ui.state.improve.cost = CostCase::Light;
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"while the light moves"}), "");
    ui.click(ui.find("found", "", "Autopilot"));
    EXPECT_EQ(ui.last_requests.find_advice->max_error, 0.02);
    EXPECT_EQ(ui.last_requests.find_advice->max_ms, 5);
    EXPECT_EQ(ui.last_requests.find_advice->cost, CostCase::Light);
    ui.advice.advising = SearchProgress{"pcf5 at 512", 0.4, 90};
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"40 %, 2 min left"}), "");
    ui.click(ui.find("found", "", "Cancel"));
    EXPECT_TRUE(ui.last_requests.cancel_advice);
}

TEST_F(ImprovePanelTest, ShowsFiguresAndAppliesAsOneUndoStep) {
    ui.advice.advice = &report;
    ui.advice.advice_current = true;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"nothing is seen of it", "-3.25 ms", "+0.0025", "error: acne everywhere", "more bias",
                          "1 tried, do not hold", "12 ms a frame while the camera moves"}),
              "");
    EXPECT_FALSE(ui.prints("this was hoped")) << "folded away";
    const Settings before = ui.state.settings;
    const auto of_first_row = [&](const char* label) {
        return ui.find("found", [=](ImGuiID seed) {
            const int row = 0;
            return ImHashStr(label, 0, ImHashData(&row, sizeof row, ImHashStr("advice", 0, seed)));
        });
    };
    ui.click(of_first_row("###show"));
    ui.frames(2);
    ASSERT_TRUE(ui.state.tried) << "seen before it is applied";
    EXPECT_EQ(ui.state.tried->settings.map.resolution, 512);
    EXPECT_EQ(ui.state.settings, before);
    EXPECT_EQ(ui.state.comparison.view, ComparisonView::Swipe);
    ui.click(of_first_row("###show"));
    ui.frames(2);
    EXPECT_FALSE(ui.state.tried) << "again: hidden";
    ui.click(of_first_row("###show"));
    ui.click(of_first_row("Apply"));
    ui.frames(2);
    EXPECT_FALSE(ui.state.tried);
    EXPECT_EQ(ui.state.settings.map.resolution, 512);
    EXPECT_EQ(ui.state.settings.filter.kernel, 0);
    ui.frames(3);
    EXPECT_EQ(ui.state.history.undo(), before) << "both settings in one step";
}

SI_TEST_IS(Later, ImprovePanelTest, HasOneAimForEverySearch);
TEST_F(ImprovePanelTest, HasOneAimForEverySearch) {
    const auto shows = [&](const char* label) { return ui.find("found", "", label).has_value(); };
    for (const auto& [aims, mode, search] : {std::tuple{"Fix the picture", ImproveMode::Picture, "Find fixes"},
                                             {"Cheaper, same look", ImproveMode::Cheaper, "Advice"},
                                             {"Within a time limit", ImproveMode::Limits, "Autopilot"},
                                             {"Fix this pixel", ImproveMode::Pixel, "Next wrong pixel"}}) {
        ui.click(ui.find("improve_", "", aims));
        ui.frames(3);
        EXPECT_EQ(ui.state.improve.mode, mode);
        EXPECT_TRUE(shows(search)) << aims;
    }
    EXPECT_FALSE(shows("Advice"));
    // The buttons at other places lead here.
    for (const auto& [label, mode] : {std::pair{"Tune...", ImproveMode::Limits}, {"Auto bias", ImproveMode::Picture}}) {
        ui.state.window.open_page = Page::Settings;
        ui.frames(3);
        ui.click(ui.find("/rows_", "bias", label));
        ui.frames(3);
        EXPECT_TRUE(ui.state.shows(Page::Improve)) << label;
        EXPECT_EQ(ui.state.improve.mode, mode) << label;
    }
    EXPECT_TRUE(ui.last_requests.tune) << "Auto bias begins at once, as before";
    ui.state.window.open_page = Page::Frontier;
    ui.frames(3);
    ui.click(ui.find("editor/bottom", "", "Advice\u2026"));
    ui.frames(3);
    EXPECT_EQ(ui.state.improve.mode, ImproveMode::Cheaper);
}

TEST_F(ImprovePanelTest, PreviewEndsWhenSettingsChange) {
    ui.advice.advice = &report;
    ui.advice.advice_current = true;
    ui.frames(3);
    const auto show = ui.find("found", [](ImGuiID seed) {
        const int row = 0;
        return ImHashStr("###show", 0, ImHashData(&row, sizeof row, ImHashStr("advice", 0, seed)));
    });
    ui.click(show);
    ui.frames(2);
    ASSERT_TRUE(ui.state.tried);
    ui.frames(5);
    EXPECT_TRUE(ui.state.tried) << "it stays";
    ui.state.settings.lights[0].azimuth += 5;
    ui.frames(2);
    EXPECT_FALSE(ui.state.tried);
    EXPECT_EQ(ui.state.comparison.view, ComparisonView::Off);
}

TEST_F(ImprovePanelTest, MarksAdviceForOtherSettings) {
    ui.advice.advice = &report;
    ui.advice.advice_current = false;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"of other settings: measure again"}), "");
}

SI_TEST_IS(Later, ImprovePanelTest, ShowsResultAndDroppedEffectsOfTheAutopilot);
TEST_F(ImprovePanelTest, ShowsResultAndDroppedEffectsOfTheAutopilot) {
    aim(ImproveMode::Limits);
    AutopilotResult flight;
    flight.goals_met = true;
    flight.summary = "hard at 512 holds it";
    flight.dropped = {{"light.contact", "0.1", "0", 0.004, {1.5, 0.2}}};
    flight.untried = {"7 of 9 combinations were not tried"};
    ui.advice.autopilot = &flight;
    ui.advice.advice_current = true;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"hard at 512 holds it", "would have cost +1.5 ms", "7 of 9 combinations"}), "");
    EXPECT_TRUE(ui.find("found", "", "Apply"));
    AutopilotCase tried;
    tried.holds = true;
    tried.ms = 4.25;
    tried.classified.error = 0.0123;
    tried.changes = {{"map.resolution", "512"}};
    flight.cases = {tried};
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"1 combinations measured"}), "") << "folded away at the end";
    flight.summary = "1 of 9 combinations measured";
    ui.advice.advising = SearchProgress{"map.resolution=1024", 0.4, 90};
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"1 of 9 combinations measured", "4.25 ms", "0.0123", "Resolution: 512 texels"}), "")
        << "rows appear as they are measured";
    ui.advice.advising.reset();
    flight.cases.clear();
    flight.goals_met = false;
    flight.summary = "it cannot be held";
    ui.frames(3);
    EXPECT_FALSE(ui.find("found", "", "Apply"));
}

TEST(ImproveWaste, IsRequestedAndShowsItsRows) {
    UiHarness ui{1600, 1600};
    open_improve(ui.state, ImproveMode::Cheaper);
    ui.frames(4);
    ui.click(ui.find("found", "", "Find waste"));
    EXPECT_TRUE(ui.last_requests.find_waste);
    Waste waste;
    waste.tried = {{.name = "map of light 0", .changes = true, .read = 0.25, .triangles = 30},
                   {.name = "map of light 1", .read = 0, .triangles = 10}};
    ui.advice.wasting = SearchProgress{"sky", 0.4, 90};
    ui.advice.waste = &waste;
    ui.advice.waste_current = true;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"40 %, 2 min left", "needed", "map of light 0, 25.00 % of its texels are read",
                          "10 of 40 triangles drawn into maps are waste (25.0 %)"}),
              "");
    EXPECT_FALSE(ui.prints("of other settings"));
    ui.click(ui.find("found", "", "Cancel##waste"));
    EXPECT_TRUE(ui.last_requests.cancel_waste);
    ui.advice.wasting.reset();
    ui.advice.waste_current = false;
    waste.stopped = true;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"of other settings: search again", "Stopped before all work was left out once."}), "");
}

SI_TEST_IS(Later, EditorWasteTest, SearchesInTheBackgroundAndChangesNothing);
TEST(EditorWasteTest, SearchesInTheBackgroundAndChangesNothing) {
    TestEditor editor(editor_options("boxes", {"map.resolution=256"}));
    EditorModel& model = editor.model();
    model.state.window.open_page = Page::Improve;
    editor.settle();
    EditorRequests request = editor.requests();
    request.find_waste = true;
    const Settings settings = model.state.settings;
    model.fulfil(request);
    EXPECT_TRUE(model.facts().wasting);
    editor.settle();
    EXPECT_FALSE(model.facts().wasting);
    ASSERT_TRUE(model.facts().waste);
    EXPECT_TRUE(model.facts().waste_current);
    EXPECT_TRUE(model.facts().waste->maps_ms);
    EXPECT_EQ(model.facts().waste->tried.front().name, "map of light 0");
    EXPECT_TRUE(model.facts().waste->tried.front().changes);
    EXPECT_EQ(model.state.settings, settings);
    model.state.settings.map.resolution = 512;
    editor.settle();
    EXPECT_FALSE(model.facts().waste_current);
}

SI_TEST_IS(Slow, EditorAdviceTest, MeasuresInTheBackgroundAndChangesNothing);
TEST(EditorAdviceTest, MeasuresInTheBackgroundAndChangesNothing) {
    TestEditor editor(editor_options("boxes", {"map.resolution=256"}));
    EditorModel& model = editor.model();
    open_improve(model.state, ImproveMode::Cheaper);
    editor.settle();
    const EditorRequests same_size = editor.requests();
    EditorRequests request = same_size;
    request.find_advice = SearchRequest{.cost = CostCase::Forced};
    const Settings settings = model.state.settings;
    model.fulfil(request);
    EXPECT_TRUE(model.facts().advising);
    editor.settle();
    EXPECT_EQ(model.state.settings, settings);
    EXPECT_FALSE(model.facts().advising);
    ASSERT_TRUE(model.facts().advice);
    EXPECT_TRUE(model.facts().advice_current);
    EXPECT_FALSE(model.facts().advice->holds.empty() && model.facts().advice->fails.empty());
    EXPECT_EQ(model.facts().advice->options.cost, CostCase::Forced);
    editor.frames(3);
    write_png(std::filesystem::path(SI_TEST_OUTPUT_DIR) / "improve_panel.png", editor.picture());
    model.state.settings.bias.normal = 7;
    editor.settle();
    EXPECT_FALSE(model.facts().advice_current) << "other settings now";
    request.find_advice->max_error = 1;
    model.fulfil(request);
    EditorRequests cancel = same_size;
    cancel.cancel_advice = true;
    model.fulfil(cancel);
    editor.settle();
    EXPECT_FALSE(model.facts().autopilot);
    EXPECT_NE(editor.last_line().find("was cancelled"), std::string::npos);
}

}  // namespace
}  // namespace si::test
