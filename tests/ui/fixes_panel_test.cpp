// Tests of the table of fixes and of the table of tuned biases: requests, clicks, and both on real frames.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "app/base/output.h"
#include "renderer/advise/fixes.h"
#include "renderer/base/lengths_text.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "ui/state/panels.h"

namespace si::test {
namespace {

FixTable made_up_fixes() {
    FixTable table;
    table.wrong = 1234;
    table.wrong_of[std::size_t(Artefact::Acne)] = 1234;
    table.candidates = 4;
    Trial least{.candidate = {.name = "least bias"}, .changes = {{"bias.constant", "2.5"}, {"bias.unit", "texels"}}};
    least.before.error = 0.1;
    least.after.error = 0.02;
    least.cured = 1200;
    least.broken = 3;
    least.ms = CostChange{0.1, 0.4};
    least.cured_of[std::size_t(Artefact::Acne)] = 1200;
    Trial finer = least;
    finer.candidate.name = "twice the resolution";
    finer.changes = {{"map.resolution", "4096"}};
    finer.cured = 600;
    finer.ms = CostChange{12.5, 0.4};
    finer.after.work.map_bytes = 48 << 20;
    finer.why_not = "maps take more than twice the bytes";
    Trial worse = finer;
    worse.candidate.name = "no bias";
    worse.after.error = 0.2;
    Trial undrawn{.candidate = {.name = "tighter fit", .untried = "only for a directional light"}};
    table.rows = {least, finer, worse, undrawn};
    return table;
}

TEST(FixesPanel, ShowsFixesAndAppliesARowAsOneUndoStep) {
    const FixTable table = made_up_fixes();
    UiHarness ui(1600, 900);
    open_improve(ui.state, ImproveMode::Picture);
    ui.state.layout.map_place = MapSpot::Hidden;
    ui.frames(4);
    ui.click(ui.find("found", "", "Find fixes"));
    ASSERT_TRUE(ui.last_requests.find_fixes);
    EXPECT_FALSE(ui.last_requests.find_fixes->pixel) << "of the picture";

    ui.fixes.running = SearchProgress{"least bias, normal offset", 0.4, 65};
    for (const bool light : {false, true}) {
        ui.state.layout.light_theme = light;
        ui.frames(3);
        EXPECT_EQ(ui.lacking({"40 %, 2 min left"}), "");
        const ImU32 bar = ImGui::GetColorU32(ImGuiCol_PlotHistogram);
        const ImDrawData* data = ImGui::GetDrawData();
        for (int i = 0; i < data->CmdListsCount; ++i)
            for (const ImDrawVert& v : data->CmdLists[i]->VtxBuffer)
                ASSERT_NE(v.col, bar) << "text on it cannot be read";
    }
    ui.state.layout.light_theme = false;
    ui.frames(2);
    ui.click(ui.find("found", "", "Cancel##cures"));
    EXPECT_TRUE(ui.last_requests.cancel_fixes);

    ui.fixes = {.running = {}, .table = &table, .pixel = {}, .current = true};
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"Fix: least bias", "twice the resolution", "1200", "< noise", "+12.5 ms", "+48 MiB", "-0.08",
                          "3 of 4 changes tried", "2 others do not help"}),
              "");
    EXPECT_FALSE(ui.prints("Fix: twice")) << "it costs too much";
    EXPECT_FALSE(ui.prints("no bias")) << "folded away";
    ui.click(ui.find("found", "", "Close##cures"));
    EXPECT_TRUE(ui.last_requests.forget_fixes);
    const Settings before = ui.state.settings;
    const auto first = [&](const char* label) {
        return ui.find("found", [=](ImGuiID seed) {
            const int row = 0;
            return ImHashStr(label, 0, ImHashData(&row, sizeof row, ImHashStr("cures", 0, seed)));
        });
    };
    ui.click(first("Fix: least bias"));
    ASSERT_TRUE(ui.state.tried) << "seen before it is applied";
    EXPECT_EQ(ui.state.tried->settings.bias.constant, 2.5);
    EXPECT_EQ(ui.state.settings, before);
    EXPECT_EQ(ui.state.comparison.view, ComparisonView::Swipe);
    ui.click(first("Fix: least bias"));
    EXPECT_FALSE(ui.state.tried) << "again: hidden";
    ui.click(first("Fix: least bias"));
    ui.click(first("Apply"));
    EXPECT_EQ(ui.state.settings.bias.constant, 2.5);
    EXPECT_FALSE(ui.state.tried);
    ui.frames(3);
    EXPECT_EQ(ui.state.history.undo(), before);

    ui.fixes.current = false;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"of other settings"}), "");
    ui.fixes.pixel = glm::ivec2(1, 2);
    ui.frames(3);
    EXPECT_FALSE(ui.prints("< noise")) << "a pixel's table is not the picture's";
}

TEST(TunedBiases, AreShownSideBySideAndTakenByAButton) {
    UiHarness ui(1600, 900);
    const auto add = [&](const char* row, const BiasSettings& bias, double score, std::size_t wrong, double shift_m) {
        TriedBias tried{.row = &*std::ranges::find(biases(), row, &Bias::key), .bias = bias};
        tried.trial.score = score;
        tried.trial.error.artefacts[std::size_t(Artefact::Acne)] = 2;
        tried.trial.error.artefacts[std::size_t(Artefact::PeterPanning)] = wrong - 2;
        tried.trial.needs.gap_p95_m = 0.012;
        tried.trial.needs.shift_p95_m = shift_m;
        ui.tuned.tried.push_back(tried);
    };
    add("normal-offset", {.constant = 0, .slope = 0, .normal = 3}, 325.4, 321, 0.034);
    add("constant", {.constant = 9, .slope = 0, .normal = 0}, 700, 654, 0);
    open_improve(ui.state, ImproveMode::Picture);
    ui.state.layout.settings_width = 40;
    ui.frames(5);
    EXPECT_EQ(ui.lacking({"Normal offset", "Constant", "325 *", "321", "654", "34 mm"}), "");
    EXPECT_FALSE(ui.prints("of other settings"));
    ui.tuned.tried[0].row = &*std::ranges::find(biases(), "receiver-plane-derivatives", &Bias::key);
    ui.state.layout.settings_width = 20;
    ui.frames(5);
    EXPECT_EQ(ui.lacking({"Receiver plane by derivatives", "wrong", "shift"}), "") << "whole names in a narrow panel";
    ui.state.layout.settings_width = 40;
    ui.frames(5);
    const Settings before = ui.state.settings;
    const auto second = [&](const char* label) {
        return ui.find("found", [=](ImGuiID seed) {
            const int row = 1;
            return ImHashStr(label, 0, ImHashData(&row, sizeof row, ImHashStr("tuned", 0, seed)));
        });
    };
    ui.click(second("##Constant"));
    ASSERT_TRUE(ui.state.tried);
    EXPECT_EQ(ui.state.tried->settings.bias.constant, 9);
    EXPECT_EQ(ui.state.settings, before) << "shown before it is taken";
    EXPECT_EQ(ui.state.comparison.view, ComparisonView::Swipe);
    ui.click(second("Take"));
    EXPECT_EQ(ui.state.settings.bias.constant, 9);
    EXPECT_FALSE(ui.state.tried);
    EXPECT_EQ(ui.state.comparison.view, ComparisonView::Off);
    ui.frames(3);
    EXPECT_EQ(ui.state.history.undo(), before) << "one step";
    ui.tuned_current = false;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"of other settings"}), "");
}

TEST(EditorFixesTest, SearchesInTheBackgroundAndTheFirstRowReachesItsFigure) {
    TestEditor editor(editor_options(
        "boxes", {"bias.kind=constant", "bias.constant=0", "bias.normal=0", "map.resolution=512"}, {960, 600}));
    EditorModel& model = editor.model();
    model.state.window.open_page = Page::Error;
    model.state.layout.bottom_height = 27;
    editor.settle();
    ASSERT_TRUE(model.facts().error);
    const auto wrong_pixels = [&] {
        const auto& artefacts = model.facts().error->metrics.artefacts;
        return std::accumulate(artefacts.begin() + 1, artefacts.end(), std::size_t(0));
    };
    const std::size_t wrong = wrong_pixels();
    EditorRequests same_size = editor.requests();
    same_size.want_error = true;
    EditorRequests request = same_size;
    request.find_fixes = FixRequest{};
    const Settings settings = model.state.settings;
    model.fulfil(request);
    EXPECT_TRUE(model.facts().fixes.running);
    EXPECT_EQ(model.state.settings, settings);
    editor.settle();
    const FixSearch search = model.facts().fixes;
    EXPECT_FALSE(search.running);
    ASSERT_TRUE(search.table);
    EXPECT_TRUE(search.current);
    open_improve(model.state, ImproveMode::Picture);
    editor.frames(5);  // columns adapt to their content
    write_png(std::filesystem::path(SI_TEST_OUTPUT_DIR) / "cures_table.png", editor.picture());
    EditorRequests narrower = same_size;
    narrower.scene_width -= 16;
    model.fulfil(narrower);
    EXPECT_FALSE(model.facts().fixes.current) << "a picture of another size";
    model.fulfil(same_size);
    EXPECT_TRUE(model.facts().fixes.current);
    EXPECT_EQ(search.table->wrong, wrong);
    ASSERT_TRUE(search.table->fix());
    const Trial first = *search.table->fix();
    EXPECT_GT(double(first.cured), 0.8 * double(wrong));
    apply_trial(model.state, first);
    model.state.window.open_page = Page::Error;
    editor.settle();
    EXPECT_FALSE(model.state.predicted);
    const std::string both =
        fmt::format("{} px wrong and mean error {} were predicted; {} and", wrong - first.cured + first.broken,
                    digits_text(first.metrics.mae), wrong - first.cured + first.broken);
    EXPECT_NE(editor.last_line().find(both), std::string::npos) << editor.last_line();
    EXPECT_FALSE(model.facts().fixes.current) << "other settings now";
    ASSERT_TRUE(model.facts().error);
    EXPECT_EQ(wrong_pixels(), wrong - first.cured + first.broken) << "exactly as predicted";
}
SI_TEST_IS(Slow, EditorFixesTest, SearchesInTheBackgroundAndTheFirstRowReachesItsFigure);

}  // namespace
}  // namespace si::test
