// Tests of the effects panel: displayed states, requests, clicks on a checkbox, and no cost while hidden.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/measure/optimisation_times.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "ui/widgets/theme.h"

namespace si::test {
namespace {

const std::vector<Effect>& made_up_effects() {
    static const std::vector<Effect> all = {
        {.name = "shadow map 0", .state = EffectState::Drawn, .reason = "It casts.", .pass = "shadow map 0"},
        {.name = "look-ups of light 7",
         .state = EffectState::NotNeeded,
         .reason = "light.7.cast is off.",
         .optimisation = Optimisation::DeadPasses,
         .pass = "visibility",
         .part = true},
        {.name = "shading", .state = EffectState::Cached, .reason = "Kept.", .pass = "shading"},
        {.name = "posing", .state = EffectState::NotNeeded, .reason = "Nothing moves."}};
    return all;
}

TEST(EffectsPanel, ShowsStateReasonAndSavingOfEachEffect) {
    UiHarness ui(1900, 1000);
    ui.state.window.open_page = Page::Effects;
    ui.effects.effects = made_up_effects();
    EXPECT_TRUE(ui.frames(4).want_effects);
    EXPECT_EQ(ui.lacking({"drawn", "not needed", "cached", "shadow map 0", "It casts.", "light.7.cast is off."}), "");
    EXPECT_FALSE(ui.prints("3.25")) << "a time that nobody measured";
    SavedTimes saved;
    saved.optimisations.push_back(
        {Optimisation::DeadPasses, {.median = 3.25, .median_low = 3, .median_high = 3.5, .samples = 15}});
    ui.effects.saved = &saved;
    ui.effects.saved_times_current = true;
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"3.25"}), "");
    EXPECT_FALSE(ui.prints("3.25 of")) << "one effect has that saving";
    EXPECT_FALSE(ui.prints("of other settings"));
    std::vector<Effect> more(ui.effects.effects.begin(), ui.effects.effects.end());
    more.push_back(
        {.name = "look-ups of light 8", .reason = "light.8.cast is off.", .optimisation = Optimisation::DeadPasses});
    ui.effects.effects = more;
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"3.25 of 2"}), "") << "two share it";
    ui.effects.effects = made_up_effects();
    ui.effects.saved_times_current = false;
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"of other settings"}), "");
}

TEST(EffectsPanel, FoldsWhatNothingNeedsIntoOneLine) {
    UiHarness ui(1900, 1000);
    ui.state.window.open_page = Page::Effects;
    ui.effects.effects = made_up_effects();
    ui.frames(4);
    EXPECT_EQ(ui.lacking({"It casts.", "Kept.", "light.7.cast is off.", "1 more: nothing needs it"}), "");
    EXPECT_FALSE(ui.prints("Nothing moves."));
    const auto sum = ui.drawn().find(U"Frame"), first = ui.drawn().find(U"shadowmap0");
    ASSERT_TRUE(sum && first);
    EXPECT_LT(sum->y, first->y) << "the sum is on top";
    const auto fold = ui.drawn().find(U"1more:nothingneedsit");
    ASSERT_TRUE(fold);
    ui.click({fold->x, fold->y});
    ui.frames(2);
    EXPECT_TRUE(ui.state.effects.all_listed);
    EXPECT_EQ(ui.lacking({"Nothing moves.", "Hide 1 that nothing needs"}), "");
}

TEST(EffectsPanel, OneBoxRunsEverything) {
    UiHarness ui(1900, 1000);
    ui.state.window.open_page = Page::Effects;
    ui.effects.effects = made_up_effects();
    ui.frames(4);
    ui.click(ui.find("effects_", "", "Run everything###force savings"));
    ui.frames(2);
    ui.click(ui.find("##Popup", "", "Everything"));
    for (std::size_t i = 0; i < kOptimisations; ++i)
        EXPECT_TRUE(ui.state.effects.forced.contains(Optimisation(i))) << i;
    ui.frames(2);
    EXPECT_EQ(ui.lacking({std::to_string(kOptimisations) + " forced"}), "");
    ui.click(ui.find("##Popup", "", "Everything"));
    EXPECT_TRUE(ui.state.effects.forced.empty());
}

TEST(EffectsPanel, TimesAreReadableAboveTheirBars) {
    UiHarness ui(1900, 1000);
    ui.state.window.open_page = Page::Effects;
    ui.effects.effects = made_up_effects();
    ui.frames(4);
    const auto number = ui.drawn().find(U"1.50", 1);  // the first is the sum's
    ASSERT_TRUE(number);
    const ImDrawData* data = ImGui::GetDrawData();
    for (int i = 0; i < data->CmdListsCount; ++i)
        for (const ImDrawVert& v : data->CmdLists[i]->VtxBuffer)
            if (v.col == theme::colours().bar && std::abs(v.pos.x - number->x) < 200) {
                EXPECT_GT(v.pos.y, number->y + 4) << "no bar strikes the number through";
            }
}

TEST(EffectsPanel, MeasurementShowsTheTimeLeft) {
    UiHarness ui(1900, 1000);
    ui.state.window.open_page = Page::Effects;
    ui.effects.effects = made_up_effects();
    ui.effects.measuring_optimisations = SearchProgress{"alternating frames", 0.4, 90};
    ui.frames(4);
    EXPECT_EQ(ui.lacking({"40 %, 2 min left"}), "");
}

TEST(EffectsPanel, NarrowWindowDropsSavingsThenReasons) {
    const auto shown = [](UiHarness& ui) {
        ui.state.window.open_page = Page::Effects;
        ui.effects.effects = made_up_effects();
        ui.frames(4);
        EXPECT_TRUE(ui.drawn().shows("look-ups of light 7"));
        EXPECT_TRUE(ui.drawn().shows("Time ms"));
        EXPECT_TRUE(ui.drawn().shows("1 more: nothing needs it"));
        EXPECT_FALSE(ui.drawn().shows("Saved ms"));
        EXPECT_FALSE(ui.drawn().shows("Force"));
    };
    {
        UiHarness ui(900, 900);
        shown(ui);
        EXPECT_TRUE(ui.drawn().shows("Why"));
        EXPECT_TRUE(ui.drawn().shows("light.7.cast is off."));
    }
    UiHarness ui(640, 900);
    shown(ui);
    EXPECT_FALSE(ui.drawn().shows("Why"));
    EXPECT_FALSE(ui.drawn().shows("light.7.cast is off."));
    const auto name = ui.drawn().find(U"look-upsoflight7");
    ASSERT_TRUE(name);
    ui.move({name->x, name->y});
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().shows("light.7.cast is off.")) << "its name says why";
}

TEST(EffectsPanel, ReasonsAreReadableInASmallWindow) {
    for (const int width : {1280, 1600}) {
        UiHarness ui(width, 2600);
        ui.state.layout = {.bottom_height = 130};
        ui.state.window.open_page = Page::Effects;
        std::vector<Effect> effects = made_up_effects();
        const std::string longest =
            "Its maps are as they were, since nothing that they depend on has changed: neither casters nor the light, "
            "nor how they are stored.";
        effects[0].reason = longest;
        ui.effects.effects = effects;
        ui.frames(4);
        EXPECT_TRUE(ui.drawn().shows(longest)) << width;
        EXPECT_TRUE(ui.drawn().shows("look-ups of light 7")) << width;
        EXPECT_TRUE(ui.drawn().shows("not needed")) << width;
        EXPECT_TRUE(ui.drawn().shows("Saved ms") && ui.drawn().shows("Force") && ui.drawn().shows("Time ms")) << width;
    }
}

TEST(EffectsPanel, TimesOfSkippedPassesAreGreyAndFramesAreALine) {
    UiHarness ui(1900, 1000);
    ui.state.window.open_page = Page::Effects;
    std::vector<Effect> effects = made_up_effects();
    ui.effects.effects = effects;
    ui.state.times = {.scene = ui.scene.name, .pass_ms = {{"shading", 7.75}}};
    ui.frames(4);
    EXPECT_TRUE(ui.drawn().shows("1.50")) << "of the pass that ran";
    EXPECT_EQ(ui.state.times.pass_ms.at("shadow map 0"), 1.5);
    EXPECT_TRUE(ui.drawn().shows("7.75")) << "of the one that is reused, as it was";
    ASSERT_EQ(ui.state.times.frames.size(), 1u) << "a frame that stays counts once";
    EXPECT_FALSE(ui.drawn().shows("2 frames in the last 30 s"));
    ui.state.times.frames.push_front({.at_s = ImGui::GetTime(), .ms = 3, .maps_ms = 1});
    ui.frames(2);
    EXPECT_TRUE(ui.drawn().shows("2 frames in the last 30 s, at most 3 ms"));
}

TEST(EffectsPanel, TimesAreKeptForSecondsOnEveryTab) {
    FrameTimes times;
    FrameResult frame;
    frame.passes = {{.name = "map", .state = PassState::Drawn, .gpu_ms = 2, .category = PassCategory::Maps},
                    {.name = "shading", .state = PassState::Drawn, .gpu_ms = 5},
                    {.name = "overlay", .state = PassState::Cached, .gpu_ms = 9}};
    keep_times(times, frame, "stage", 100);
    keep_times(times, frame, "stage", 101);
    ASSERT_EQ(times.frames.size(), 1u);
    EXPECT_EQ(times.frames[0].ms, 7);
    EXPECT_EQ(times.frames[0].maps_ms, 2);
    EXPECT_TRUE(times.frames[0].drew_maps);
    EXPECT_EQ(times.frames[0].at_s, 100);
    EXPECT_FALSE(times.pass_ms.contains("overlay"));
    frame.passes[1].gpu_ms = 6;
    keep_times(times, frame, "stage", 129);
    EXPECT_EQ(times.frames.size(), 2u);
    keep_times(times, frame, "stage", 131);
    EXPECT_EQ(times.frames.size(), 1u) << "older than half a minute";
    keep_times(times, frame, "stage", 500);
    EXPECT_EQ(times.frames.size(), 1u) << "the last one is never forgotten";
    EXPECT_TRUE(times.newest_is_shown);
    for (PassInfo& pass : frame.passes) pass.gpu_ms = 0;
    keep_times(times, frame, "stage", 501);
    EXPECT_FALSE(times.newest_is_shown);
    keep_times(times, frame, "boxes", 502);
    EXPECT_TRUE(times.frames.empty()) << "of another scene";
    EXPECT_TRUE(times.pass_ms.empty());

    UiHarness ui(1900, 1000);
    ui.state.window.open_page = Page::Log;
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().shows("frame 1.50 ms, no map drawn"));
    EXPECT_FALSE(ui.drawn().shows("last timed"));
}

SI_TEST_IS(Later, EffectsPanel, CheckboxForcesAnOptimisationOffAndResetRestoresIt);
TEST(EffectsPanel, CheckboxForcesAnOptimisationOffAndResetRestoresIt) {
    UiHarness ui(1900, 1000);
    ui.state.window.open_page = Page::Effects;
    ui.effects.effects = made_up_effects();
    ui.frames(4);
    const Settings before = ui.state.settings;
    ui.state.effects.forced = {Optimisation::DeadPasses};
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"1 forced"}), "");
    ui.click(ui.find("bottom", "", "Reset##forced"));
    EXPECT_TRUE(ui.state.effects.forced.empty());
    // The row's checkbox, in the last column.
    bool clicked = false;
    for (float y = 680; y < 990 && !clicked; y += 6)
        for (float x = 1400; x < 1530 && !clicked; x += 8) {
            ui.move({x, y});
            ui.frame();
            if (ui.hovered() == 0) continue;
            ui.click({x, y});
            clicked = ui.state.effects.forced.contains(Optimisation::DeadPasses);
        }
    EXPECT_TRUE(clicked);
    EXPECT_EQ(ui.state.settings, before) << "a tool, no setting";
}

SI_TEST_IS(Later, EffectsPanel, RequestsAndCancelsAMeasurement);
TEST(EffectsPanel, RequestsAndCancelsAMeasurement) {
    UiHarness ui(1900, 1000);
    ui.state.window.open_page = Page::Effects;
    ui.frames(4);
    ui.click(ui.find("bottom", "", "Measure what is saved"));
    EXPECT_TRUE(ui.last_requests.measure_saved_times);
    ui.effects.measuring_optimisations = SearchProgress{"alternating frames", 0.4};
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"40%"}), "");
    ui.click(ui.find("bottom", "", "Cancel##saved"));
    EXPECT_TRUE(ui.last_requests.cancel_measuring);
}

const Effect* shown_effect(const EditorFrame& facts, std::string_view name) {
    for (const Effect& e : facts.effects)
        if (e.name == name) return &e;
    return nullptr;
}

SI_TEST_IS(Later, EditorEffects, AreComputedOnlyWhileThePanelIsShown);
TEST(EditorEffects, AreComputedOnlyWhileThePanelIsShown) {
    TestEditor editor;
    EditorState& state = editor.state();
    state.window.open_page = Page::Effects;
    editor.settle();
    EXPECT_TRUE(shown_effect(editor.facts(), "depth blur"));
    const Effect* objects = shown_effect(editor.facts(), "panel: objects lost to culling");
    ASSERT_TRUE(objects);
    EXPECT_EQ(objects->state, EffectState::NotNeeded);
    state.window.open_page = Page::Log;
    editor.settle();
    EXPECT_TRUE(editor.facts().effects.empty());
    state.window.open_page = Page::Effects;
    editor.settle();
    EXPECT_TRUE(shown_effect(editor.facts(), "depth blur"));
    EXPECT_FALSE(editor.model().fulfil(editor.frame())) << "a still editor has something to draw";

    // Loupe and comparison are effects of the panel.
    const auto state_of = [&](std::string_view name) {
        editor.settle();
        const Effect* e = shown_effect(editor.facts(), name);
        return e ? std::optional(e->state) : std::nullopt;
    };
    EXPECT_EQ(state_of("panel: loupe"), EffectState::NotNeeded);
    EXPECT_EQ(state_of("panel: other side of the comparison"), EffectState::NotNeeded);
    state.comparison.view = ComparisonView::SideBySide;
    EXPECT_EQ(state_of("panel: other side of the comparison"), EffectState::Drawn);
    state.comparison.view = ComparisonView::Off;
    EXPECT_EQ(state_of("panel: other side of the comparison"), EffectState::NotNeeded);
    state.probe_pixel = glm::ivec2(300, 200);
    EXPECT_EQ(state_of("panel: loupe"), EffectState::Drawn);
    EXPECT_EQ(state_of("panel: cross-section"), EffectState::NotNeeded) << "its panel is hidden";
}

SI_TEST_IS(Later, EditorEffects, NextArtefactIsSearchedOnceAndListed);
TEST(EditorEffects, NextArtefactIsSearchedOnceAndListed) {
    TestEditor editor(
        editor_options("boxes", {"bias.kind=constant", "bias.constant=0", "bias.normal=0", "view.overlay=artefacts"}));
    EditorState& state = editor.state();
    state.window.open_page = Page::Effects;
    const auto listed = [&] {
        editor.settle();
        const Effect* e = shown_effect(editor.facts(), "panel: next artefact");
        return e ? *e : Effect{};
    };
    EXPECT_EQ(listed().state, EffectState::NotNeeded);
    state.artefacts = {Artefact::Acne, 1};
    const Effect found = listed();
    EXPECT_EQ(found.state, EffectState::Drawn) << found.reason;
    state.settings.shading.exposure += 0.5;
    const Effect kept = listed();
    EXPECT_EQ(kept.state, EffectState::Cached) << kept.reason;
    EXPECT_EQ(kept.reason.substr(0, kept.reason.find(' ')), found.reason.substr(0, found.reason.find(' ')));
    EXPECT_GT(std::stoi(found.reason), 0) << found.reason;
    state.artefacts.number = 2;
    EXPECT_EQ(listed().state, EffectState::Drawn);
}

SI_TEST_IS(Later, EditorEffects, SavingsAreMeasuredInTheBackgroundAndAForcedFrameIsRedrawn);
TEST(EditorEffects, SavingsAreMeasuredInTheBackgroundAndAForcedFrameIsRedrawn) {
    TestEditor editor(
        editor_options("boxes", {"light.cast=false", "shading.separate_visibility=true", "map.resolution=256"}));
    EXPECT_FALSE(editor.facts().saved);
    EditorRequests requests = editor.frame();
    requests.measure_saved_times = true;
    EXPECT_TRUE(editor.model().fulfil(requests));
    EXPECT_TRUE(editor.model().measuring());
    EXPECT_TRUE(editor.facts().measuring_optimisations);
    editor.settle();
    ASSERT_TRUE(editor.facts().saved);
    EXPECT_TRUE(editor.facts().saved_times_current);
    const Spread* ms = editor.facts().saved->saved_ms(Optimisation::DeadPasses);
    ASSERT_TRUE(ms) << "an effect names this saving";
    EXPECT_EQ(ms->samples, kSavedTimeRounds);
    EXPECT_LE(ms->median_low, ms->median_high);
    editor.state().settings.map.resolution = 512;
    editor.settle();
    EXPECT_FALSE(editor.facts().saved_times_current);
    requests = editor.frame();
    requests.measure_saved_times = true;
    editor.model().fulfil(requests);
    requests.measure_saved_times = false;
    requests.cancel_measuring = true;
    editor.model().fulfil(requests);
    editor.settle();
    EXPECT_FALSE(editor.facts().saved_times_current) << "a cancelled measurement tells nothing";

    const auto skipped = [&] {
        const Effect* e = shown_effect(editor.facts(), "look-ups of light 0");
        return e && e->state == EffectState::NotNeeded;
    };
    editor.state().window.open_page = Page::Effects;
    editor.settle();
    EXPECT_TRUE(skipped());
    editor.state().effects.forced = {Optimisation::DeadPasses};
    editor.settle();
    EXPECT_FALSE(skipped());
    EXPECT_GT(editor.facts().result->pass("visibility")->draws, 0u);
}

}  // namespace
}  // namespace si::test
