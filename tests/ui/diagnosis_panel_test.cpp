// Tests of the pixel diagnosis in the probe panel and of the search for the minimum bias: buttons, undo, progress, real
// frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/advise/fixes.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "ui/scene_view/kernel_marks.h"

namespace si::test {
namespace {

PixelDiagnosis acne_diagnosis() {
    PixelDiagnosis d;
    d.reference.state = PixelState::Counted;
    d.least = {0.001, 1.8, 0.02};
    d.has = {0.0003, 0.6, 0.007};
    d.right = false;
    d.reference.cause.artefact = Artefact::Acne;
    d.verdict = "acne: needs 1.8 texels of bias here, has 0.6 texels";
    d.fix = SuggestedFix{{{"bias.slope", "4.5"}}, "set bias.slope to 4.5 texels"};
    return d;
}

/// ID of the group of light 0: the bytes of its number.
const std::string kGroupOfLight(sizeof(int), '\0');

SI_TEST_IS(Later, DiagnosisPanel, ShowsAFixOnlyOnceItWasTried);
TEST(DiagnosisPanel, ShowsAFixOnlyOnceItWasTried) {
    UiHarness ui(1280, 720);
    ui.state.probe_pixel = glm::ivec2(3, 4);
    ui.state.window.open_page = Page::Pixel;
    ui.diagnoses = {acne_diagnosis()};
    ui.frames(5);
    ASSERT_TRUE(ui.last_requests.find_fixes) << "the search begins by itself";
    EXPECT_EQ(ui.last_requests.find_fixes->pixel, glm::ivec2(3, 4));
    EXPECT_TRUE(ui.last_requests.find_fixes->first);
    EXPECT_FALSE(ui.prints("Fix: "));
    ui.fixes.running = SearchProgress{"least bias, adaptive", 0.1};
    ui.last_requests = {};
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"trying least bias, adaptive..."}), "");
    EXPECT_FALSE(ui.last_requests.find_fixes) << "once";

    FixTable table;
    table.rows = {{.candidate = {.name = "least bias, slope"}, .changes = {{"bias.slope", "4.5"}}}};
    ui.fixes = {.running = {}, .table = &table, .pixel = ui.state.probe_pixel, .current = true};
    ui.frames(3);
    const Settings before = ui.state.settings;
    ui.click(ui.find("/pixel_", kGroupOfLight, "Fix: least bias, slope"));
    EXPECT_EQ(ui.state.settings.bias.slope, 4.5);
    ui.frames(3);
    EXPECT_EQ(ui.state.history.undo(), before);
    EXPECT_FALSE(ui.state.history.can_undo());

    table.rows[0].why_not = "the mean error rises";
    ui.state.settings = before;
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"No fix among 1 changes that were tried"}), "");
    EXPECT_FALSE(ui.find("/pixel_", kGroupOfLight, "Fix: least bias, slope"));
}

TEST(SuggestedFixes, ShowLabelsAndTheirEquivalentBias) {
    SuggestedFix fix{{{"bias.slope", "4.5"}}, "set bias.slope to 4.5 texels", 1.804};
    const Settings slope = [] {
        Settings s;
        set_setting(s, "bias.kind", "slope");
        return s;
    }();
    EXPECT_EQ(fix_text(fix, slope) + equivalent_bias_text(fix),
              "Slope bias 4.5 texels (equivalent depth bias 1.8 texels)");
    fix.equivalent_bias_texels = 0;
    EXPECT_EQ(equivalent_bias_text(fix), "");
    const SuggestedFix two{{{"bias.normal", "0"}, {"map.resolution", "4096"}}, "", 0};
    EXPECT_EQ(fix_text(two, Settings{}), "Normal offset 0 texels, Resolution 4096 texels");
}

TEST(DiagnosisPanel, DrawsDuringReferenceTracingAtAnySize) {
    for (const auto& [w, h, scale] : {std::tuple{1280, 720, 1.0f}, {3840, 2160, 2.0f}, {700, 480, 1.0f}}) {
        UiHarness ui(w, h, scale);
        ui.state.probe_pixel = glm::ivec2(3, 4);
        ui.state.window.open_page = Page::Pixel;
        ui.tracing_probe = true;
        ui.frames(4);
        ui.tracing_probe = false;
        ui.diagnoses = {acne_diagnosis()};
        ui.frames(4);
        ui.diagnoses[0].occluder = {0.0001, 0.3, 0.002};  // no bias is right
        ui.frames(4);
    }
}

SI_TEST_IS(Later, TuneControls, ButtonsRequestAndCancelASearch);
TEST(TuneControls, ButtonsRequestAndCancelASearch) {
    UiHarness ui(1280, 720);
    ui.frames(4);
    ui.click(ui.find("/rows_", "bias", "Auto bias"));
    ASSERT_TRUE(ui.last_requests.tune);
    EXPECT_FALSE(ui.last_requests.tune->max_error || ui.last_requests.tune->max_ms);

    ui.state.window.open_page = Page::Settings;
    ui.frames(3);
    ui.click(ui.find("/rows_", "bias", "Tune..."));
    ui.frames(3);
    static_cast<LimitFields&>(ui.state.improve) = {
        .bound_error = true, .bound_ms = true, .max_error = 0.02, .max_ms = 7};
    ui.state.improve.area = true;
    ui.click(ui.find("found", "", "Tune"));
    ASSERT_TRUE(ui.last_requests.tune);
    EXPECT_EQ(ui.last_requests.tune->max_error, 0.02);
    EXPECT_EQ(ui.last_requests.tune->max_ms, 7);
    EXPECT_TRUE(ui.last_requests.tune->area);

    ui.tuning = SearchProgress{"Normal offset: 2 texels", 0.4, 12};
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"40 %, 12 s left"}), "");
    EXPECT_FALSE(ui.find("found", "", "Tune")) << "one search at a time";
    ui.click(ui.find("found", "", "Cancel##tune"));
    EXPECT_TRUE(ui.last_requests.cancel_tune);
}

TEST(TuneControls, SearchIsDisabledWithoutAMap) {
    UiHarness ui(1280, 720);
    ui.state.settings.lights[0].source = 1;
    ASSERT_FALSE(source_of(ui.state.settings, 0).needs.map);
    ui.frames(4);
    for (const char* label : {"Auto bias", "Tune..."}) {
        ui.click(ui.find("/rows_", "bias", label));
        EXPECT_FALSE(ui.last_requests.tune) << label;
        EXPECT_TRUE(ui.state.shows(Page::Settings)) << label;
    }
}

TEST(KernelMarks, TapsAreColouredByTheirResult) {
    KernelTap lit{.weight = 1, .lit = true}, own{.weight = 1, .lit = false, .meets = KernelTap::Meets::Own},
        dark{.weight = 1, .lit = false, .meets = KernelTap::Meets::Nearer}, light{.weight = 0.1, .lit = true};
    EXPECT_NE(tap_colour(lit, 1), tap_colour(dark, 1));
    EXPECT_NE(tap_colour(own, 1), tap_colour(dark, 1));
    EXPECT_LT(tap_colour(light, 1) >> IM_COL32_A_SHIFT, tap_colour(lit, 1) >> IM_COL32_A_SHIFT);
}

EditorOptions biased_boxes() {
    return editor_options("boxes", {"bias.kind=constant", "bias.normal=0", "bias.constant=0.1", "map.resolution=512"});
}

TEST(EditorDiagnosisTest, ClickedPixelIsDiagnosedAndItsFixCuresIt) {
    TestEditor editor(biased_boxes());
    EditorState& state = editor.state();
    // Finds a pixel darkened by acne, on a grid over the picture.
    std::optional<PixelDiagnosis> found;
    for (int y = 256; y < 556 && !found; y += 12)
        for (int x = 40; x < 500 && !found; x += 12) {
            state.probe_pixel = glm::ivec2(x, y);
            editor.settle();
            const EditorFrame facts = editor.facts();
            EXPECT_FALSE(facts.tracing_probe) << "settled";
            if (!facts.probe || !facts.probe->hit) continue;
            ASSERT_EQ(facts.diagnoses.size(), facts.probe->lights.size());
            if (facts.diagnoses[0].cause().artefact == Artefact::Acne) found = facts.diagnoses[0];
        }
    ASSERT_TRUE(found);
    EXPECT_EQ(found->verdict.find("acne: needs"), 0u) << found->verdict;
    state.window.open_page = Page::Pixel;  // begins the search for a fix
    editor.frames(3);
    editor.settle();
    const FixSearch search = editor.facts().pixel_fixes;
    ASSERT_TRUE(search.table && search.current);
    EXPECT_EQ(search.pixel, state.probe_pixel);
    ASSERT_TRUE(search.table->fix());
    for (const auto& [key, value] : search.table->fix()->changes) set_setting(state.settings, key, value);
    editor.settle();
    const EditorFrame after = editor.facts();
    ASSERT_EQ(after.diagnoses.size(), 1u);
    EXPECT_TRUE(after.diagnoses[0].right) << after.diagnoses[0].verdict;
}
SI_TEST_IS(Slow, EditorDiagnosisTest, ClickedPixelIsDiagnosedAndItsFixCuresIt);

EditorRequests small_picture() {
    EditorRequests request;
    request.scene_width = 320;
    request.scene_height = 180;
    return request;
}

SI_TEST_IS(Later, EditorTuning, FindsTheLeastBiasInTheBackgroundAndShowsIt);
TEST(EditorTuning, FindsTheLeastBiasInTheBackgroundAndShowsIt) {
    TestEditor editor(biased_boxes());
    EditorModel& model = editor.model();
    const Settings before = model.state.settings;
    EditorRequests request = small_picture();
    model.fulfil(request);
    request.tune = SearchRequest{};
    model.fulfil(request);
    EXPECT_TRUE(model.facts().tuning) << "it goes on in the background";
    EXPECT_EQ(model.state.settings, before) << "and the editor went on at once";
    editor.settle();
    EXPECT_FALSE(model.facts().tuning);
    EXPECT_EQ(model.state.settings, before) << "the result is shown before it is taken";
    ASSERT_TRUE(model.state.tried);
    const Settings after = model.state.tried->settings;
    EXPECT_NE(after.bias, before.bias);
    Settings only_bias = before;
    only_bias.bias = after.bias;
    EXPECT_EQ(after, only_bias);
    EXPECT_EQ(model.state.comparison.view, ComparisonView::Swipe);
    editor.frames(3);
    ASSERT_TRUE(editor.facts().picture_comparison);
    EXPECT_NE(editor.facts().picture_comparison->picture.texture, 0u) << editor.facts().picture_comparison->problem;
    const auto& lines = model.state.log.lines();
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& line) {
        return line.text.find("least bias: ") != std::string::npos &&
               line.text.find("gap at casters") != std::string::npos;
    }));
    EXPECT_GT(model.facts().tuned->tried.size(), 1u);
    EXPECT_FALSE(model.facts().tuned_current) << "of a picture of another size";
    model.fulfil(small_picture());
    EXPECT_TRUE(model.facts().tuned_current);
    model.state.settings = after;
    EXPECT_TRUE(model.facts().tuned_current) << "whatever the bias";
    model.state.settings = before;
    model.state.settings.lights[0].azimuth += 10;
    EXPECT_FALSE(model.facts().tuned_current);
}

SI_TEST_IS(Later, EditorTuning, ComparesWithAnAreaOnRequest);
TEST(EditorTuning, ComparesWithAnAreaOnRequest) {
    TestEditor editor(biased_boxes());
    EditorModel& model = editor.model();
    model.state.settings.lights[0].size = 1;
    model.state.settings.truth.samples = 4;
    const Settings before = model.state.settings;
    ASSERT_FALSE(before.truth.area);
    EditorRequests request = small_picture();
    model.fulfil(request);
    request.tune = SearchRequest{.area = true};
    model.fulfil(request);
    editor.settle();
    ASSERT_TRUE(model.state.tried);
    EXPECT_NE(model.state.tried->settings.bias, before.bias);
    EXPECT_FALSE(model.state.tried->settings.truth.area) << "the search's own setting";
}

SI_TEST_IS(Later, EditorTuning, IsNotShownBesideOtherSettings);
TEST(EditorTuning, IsNotShownBesideOtherSettings) {
    TestEditor editor(biased_boxes());
    EditorModel& model = editor.model();
    EditorRequests request = small_picture();
    model.fulfil(request);
    request.tune = SearchRequest{};
    model.fulfil(request);
    model.state.settings.lights[0].elevation += 10;
    const Settings turned = model.state.settings;
    editor.settle();
    EXPECT_EQ(model.state.settings, turned);
    EXPECT_FALSE(model.state.tried);

    model.fulfil(request);
    EditorRequests cancel = small_picture();
    cancel.cancel_tune = true;
    model.fulfil(cancel);
    editor.settle();
    EXPECT_FALSE(model.facts().tuning);
    EXPECT_EQ(model.state.settings, turned);
}

SI_TEST_IS(Later, EditorTuning, IsNotShownForAnotherLight);
TEST(EditorTuning, IsNotShownForAnotherLight) {
    EditorOptions options = biased_boxes();
    options.session.sets.emplace_back("light.count=2");
    TestEditor editor(options);
    EditorModel& model = editor.model();
    EditorRequests request = small_picture();
    model.fulfil(request);
    request.tune = SearchRequest{};
    model.fulfil(request);
    model.state.settings.view.light = 1;
    editor.settle();
    EXPECT_FALSE(model.state.tried);
    const auto& lines = model.state.log.lines();
    EXPECT_TRUE(std::ranges::any_of(lines, [](const auto& line) { return line.text.starts_with("Not shown, as "); }));
}

}  // namespace
}  // namespace si::test
