// Tests of the ray-traced reference in the whole editor: numbers that follow the settings, overlays, and picture
// comparison.
#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/base/output.h"
#include "renderer/base/held_memory.h"
#include "renderer/measure/measured_error.h"
#include "renderer/reference/light_map_cache.h"
#include "renderer/reference/live_error.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/state/panels.h"

namespace si {
namespace {

const std::filesystem::path kOut = SI_TEST_OUTPUT_DIR;

using test::expect_calm;

EditorOptions options(const std::vector<std::string>& sets) {
    return test::editor_options("boxes", sets);
}

const std::vector<std::string> kNoBias = {"bias.kind=constant", "bias.constant=0", "bias.normal=0",
                                          "filter.kernel=hard", "view.frustum=false"};

/// Draws until the editor traces rays, and cancels. @param picture file of the editor's picture meanwhile; null: none
void cancel_tracing(HeadlessEditor& editor, const char* picture = nullptr) {
    EditorModel& model = editor.model();
    for (int i = 0; i < 20 && !model.tracing(); ++i) {
        model.finish_loading();
        editor.frame();
    }
    ASSERT_TRUE(model.tracing());
    EditorRequests cancel = editor.frame();
    if (picture) {
        EXPECT_EQ(model.facts().reference->doing, "Baking the light map");
        write_png(kOut / picture, editor.picture());
    }
    cancel.cancel_reference = true;
    model.fulfil(cancel);
    editor.settle();
    EXPECT_EQ(model.facts().reference->problem, "Cancelled");
}

/// Counts the bytes that differ in two pictures of one size.
std::size_t different_bytes(const ByteImage& a, const ByteImage& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i) count += a.data[i] != b.data[i];
    return count;
}

SI_TEST_IS(Later, EditorReference, TracesOnlyOnRequestAndFollowsTheBias);
TEST(EditorReference, TracesOnlyOnRequestAndFollowsTheBias) {
    test::TestEditor editor(options(kNoBias));
    EXPECT_FALSE(editor.model().facts().error) << "nothing asked for it";
    EXPECT_FALSE(editor.model().facts().reference->wanted);

    EditorState& state = editor.model().state;
    state.window.open_page = Page::Error;
    editor.settle();
    const auto error = [&] { return editor.model().facts().error; };
    ASSERT_TRUE(error());
    EXPECT_TRUE(editor.model().facts().reference->current);
    const ErrorMetrics before = error()->metrics;
    EXPECT_GT(before.acne, 0.1);
    write_png(kOut / "editor_error.png", editor.picture());

    // `measure` gives the same values at this size.
    {
        const FrameResult& shown = *editor.model().facts().result;
        Renderer renderer;
        ReferenceCache cache;
        const MeasuredError measured =
            measure_error(renderer, load_scene("boxes"), state.settings,
                          {.width = shown.colour.width, .height = shown.colour.height}, 0, {}, cache);
        EXPECT_EQ(measured.metrics.artefacts, before.artefacts);
    }

    state.settings.bias.constant = 4;
    for (int i = 0; i < 2; ++i) {
        editor.frame();
        EXPECT_NE(editor.model().facts().reference->doing, "Tracing rays") << "a slider that moves waits for nothing";
        EXPECT_TRUE(error());
    }
    ASSERT_TRUE(error());
    EXPECT_LT(error()->metrics.acne, 0.2 * before.acne);
    EXPECT_TRUE(editor.model().facts().reference->current);

    state.settings.lights[0].azimuth += 10;
    editor.frame();
    EXPECT_FALSE(error()) << "the light moved: the old truth says nothing of it";
    const LiveError* const earlier = editor.model().facts().earlier_error;
    ASSERT_TRUE(earlier) << "for the panel, which shows it in grey";
    EXPECT_LT(earlier->metrics.acne, 0.2 * before.acne);
    EXPECT_FALSE(editor.model().facts().reference->current);
    editor.settle();
    EXPECT_TRUE(error());
    state.window.open_page = Page::Effects;
    editor.settle();
    EXPECT_FALSE(error());
    expect_calm(editor);
}

SI_TEST_IS(Later, EditorReference, CancelHoldsUntilAChange);
TEST(EditorReference, CancelHoldsUntilAChange) {
    // More rays than can be traced before the cancel.
    std::vector<std::string> sets = kNoBias;
    for (const char* set : {"truth.area=true", "truth.samples=4096", "truth.noise=0", "light.size=5"})
        sets.push_back(set);
    HeadlessEditor editor(options(sets));
    editor.model().state.window.open_page = Page::Error;
    ASSERT_NO_FATAL_FAILURE(cancel_tracing(editor));
    EXPECT_FALSE(editor.model().facts().error);
    editor.model().state.settings.truth.area = false;
    editor.settle();
    EXPECT_TRUE(editor.model().facts().error);
}

SI_TEST_IS(Later, EditorReference, OverlayWaitsForTheReferenceAndShowsIt);
TEST(EditorReference, OverlayWaitsForTheReferenceAndShowsIt) {
    HeadlessEditor editor(options(kNoBias));
    set_setting(editor.model().state.settings, "view.overlay", "artefacts");
    set_setting(editor.model().state.settings, "view.overlay_2", "truth");
    editor.model().state.settings.view.panes = Panes::Two;
    editor.model().finish_loading();
    for (int i = 0; i < 3; ++i) editor.frame();
    ASSERT_TRUE(editor.model().facts().result);
    EXPECT_TRUE(editor.model().facts().result->panes.front().lacks_reference);
    const ByteImage waiting = editor.picture();
    const int width = editor.model().facts().result->colour.width,
              height = editor.model().facts().result->colour.height;
    editor.settle();
    for (const Pane& pane : editor.model().facts().result->panes) {
        EXPECT_FALSE(pane.lacks_reference);
        EXPECT_GT(pane.overlay, 0);
    }
    ASSERT_TRUE(editor.model().facts().error) << "for the legend";
    EXPECT_NE(editor.picture().data, waiting.data);
    EXPECT_EQ(editor.model().facts().result->colour.width, width);
    EXPECT_EQ(editor.model().facts().result->colour.height, height) << "or the truth would be of another size again";
    write_png(kOut / "editor_artefacts.png", editor.picture());
    expect_calm(editor);
}

/// Returns the number of traced receivers in memory.
std::size_t receivers_held() {
    for (const MemoryUse& h : memory_report().holders)
        if (h.holder == "receivers") return h.count;
    return 0;
}

SI_TEST_IS(Later, EditorReference, KeepsEarlierViewsOfTheSameCastersOnly);
TEST(EditorReference, KeepsEarlierViewsOfTheSameCastersOnly) {
    const std::size_t others = receivers_held();
    std::vector<std::string> sets = kNoBias;
    sets.push_back("camera.source=manual");
    HeadlessEditor editor(options(sets));
    EditorState& state = editor.model().state;
    state.window.open_page = Page::Error;
    state.comparison = {.view = ComparisonView::SideBySide, .reference = false};
    editor.settle();
    EXPECT_GE(receivers_held(), others + 1);
    // The other side disappears when the reference of another view arrives.
    state.comparison.view = ComparisonView::Off;
    state.settings.camera.azimuth += 5;
    editor.settle();
    const std::size_t two_views = receivers_held();
    EXPECT_GE(two_views, others + 2);
    editor.model().release_unused_memory();
    EXPECT_LE(receivers_held(), two_views);
    state.settings.scene.distance = 3;
    editor.settle();
    editor.model().release_unused_memory();
    EXPECT_EQ(receivers_held(), others + 1) << "the casters have moved";
}

SI_TEST_IS(Later, EditorReference, ViewThatComesBackNeedsNoRays);
TEST(EditorReference, ViewThatComesBackNeedsNoRays) {
    std::vector<std::string> sets = kNoBias;
    sets.push_back("camera.source=manual");
    HeadlessEditor editor(options(sets));
    EditorModel& model = editor.model();
    model.state.window.open_page = Page::Error;
    editor.settle();
    ASSERT_TRUE(model.facts().error);
    const ErrorMetrics before = model.facts().error->metrics;
    model.state.settings.camera.azimuth += 10;
    editor.settle();
    ASSERT_TRUE(model.facts().error);
    EXPECT_NE(model.facts().error->metrics.mae, before.mae);
    model.state.settings.camera.azimuth -= 10;
    for (int i = 0; i < 6; ++i) {
        editor.frame();
        EXPECT_FALSE(model.tracing()) << "frame " << i;
    }
    ASSERT_TRUE(model.facts().error);
    EXPECT_EQ(model.facts().error->metrics.artefacts, before.artefacts);
    expect_calm(editor);
}

SI_TEST_IS(Later, EditorReference, TabsNeitherRestartTheTraceNorMoveThePicture);
TEST(EditorReference, TabsNeitherRestartTheTraceNorMoveThePicture) {
    // More rays than any machine traces before the last tab.
    std::vector<std::string> sets = kNoBias;
    for (const char* set : {"truth.area=true", "truth.samples=1048576", "truth.noise=0", "light.size=5"})
        sets.push_back(set);
    HeadlessEditor editor(options(sets));
    EditorModel& model = editor.model();
    model.state.window.open_page = Page::Error;
    constexpr double kSomeRays = 0.2;  // the share of the work before the rays to the light
    double progress = 0;
    for (int i = 0; i < 5000 && progress <= kSomeRays; ++i) {
        model.finish_loading();
        editor.frame();
        progress = model.facts().reference->progress;
    }
    ASSERT_GT(progress, kSomeRays);
    const glm::dvec2 origin = model.state.viewport.view->origin, size = model.state.viewport.view->size;
    for (int click = 0; click < 100; ++click) {
        const auto page = Page(click % kPages);
        model.state.window.open_page = page;
        for (int frame = 0; frame < 3; ++frame) editor.frame();
        ASSERT_TRUE(model.state.shows(page));
        ASSERT_TRUE(model.tracing()) << "click " << click;
        ASSERT_GE(model.facts().reference->progress, progress) << "click " << click;
        progress = model.facts().reference->progress;
        ASSERT_EQ(model.state.viewport.view->origin, origin) << "click " << click;
        ASSERT_EQ(model.state.viewport.view->size, size) << "click " << click;
    }
    ASSERT_NO_FATAL_FAILURE(cancel_tracing(editor));
}

SI_TEST_IS(Later, EditorReference, PixelsAppearWhileTheyAreTracedAndStayAfterCancel);
TEST(EditorReference, PixelsAppearWhileTheyAreTracedAndStayAfterCancel) {
    std::vector<std::string> sets = kNoBias;
    for (const char* set : {"truth.area=true", "truth.samples=1048576", "truth.noise=0", "light.size=5",
                            "view.overlay=truth", "view.axes=false"})
        sets.push_back(set);
    HeadlessEditor editor(options(sets));
    EditorModel& model = editor.model();
    model.finish_loading();
    editor.frame();
    const ByteImage before = editor.picture();
    for (int i = 0; i < 5000 && model.facts().traced_so_far.texture == 0; ++i) editor.frame();
    ASSERT_NE(model.facts().traced_so_far.texture, 0u) << "no pixel appeared";
    EXPECT_FALSE(model.facts().reference->current);
    EXPECT_GT(model.facts().reference->traced_share, 0);
    editor.frame();
    write_png(kOut / "editor_tracing.png", editor.picture());
    EXPECT_GT(different_bytes(editor.picture(), before), 10000u);
    ASSERT_NO_FATAL_FAILURE(cancel_tracing(editor));
    EXPECT_NE(model.facts().traced_so_far.texture, 0u) << "what it has stays";
    model.state.settings.camera.source = CameraSource::Manual;
    model.state.settings.camera.azimuth += 40;
    set_setting(model.state.settings, "truth.area", "false");
    editor.settle();
    EXPECT_EQ(model.facts().traced_so_far.texture, 0u) << "the reference is finished";
    expect_calm(editor);
}

SI_TEST_IS(Later, EditorReference, SavesAllNumbers);
TEST(EditorReference, SavesAllNumbers) {
    const std::filesystem::path file = kOut / "editor_error.json";
    std::filesystem::remove(file);
    HeadlessEditor editor(options(kNoBias));
    editor.model().state.window.open_page = Page::Error;
    editor.settle();
    EditorRequests save = editor.frame();
    save.save_error = file.string();
    editor.model().fulfil(save);
    editor.settle();
    ASSERT_TRUE(std::filesystem::exists(file));
    const auto json = nlohmann::json::parse(std::ifstream(file));
    EXPECT_NEAR(json["error"]["acne"], editor.model().facts().error->metrics.acne, 1e-9);
    EXPECT_TRUE(json["error"]["boundary_px_mean"].is_number()) << "what a frame alone cannot tell";
    save.save_error = (kOut / "no such folder" / "x.json").string();
    editor.model().fulfil(save);
    EXPECT_EQ(editor.model().state.log.lines().back().kind, LogKind::Error);
}

SI_TEST_IS(Later, EditorReference, SavedErrorsReplaceAFileOnlyAfterConfirmation);
TEST(EditorReference, SavedErrorsReplaceAFileOnlyAfterConfirmation) {
    const std::filesystem::path file = fresh_test_folder() / "error.json";
    std::ofstream(file) << "mine";
    HeadlessEditor editor(options(kNoBias));
    EditorState& state = editor.model().state;
    state.window.open_page = Page::Error;
    editor.settle();
    EditorRequests save = editor.frame();
    save.save_error = file.string();
    editor.model().fulfil(save);
    ASSERT_TRUE(state.files.replace) << "nobody was asked";
    EXPECT_EQ(state.files.replace->path, file.string());
    EXPECT_TRUE(state.files.replace->errors);
    state.files.replace.reset();  // cancelled
    editor.settle();
    EXPECT_EQ(file_bytes(file), "mine");
    save.replace = true;
    editor.model().fulfil(save);
    editor.settle();
    EXPECT_TRUE(nlohmann::json::parse(std::ifstream(file)).contains("error"));
    std::ofstream(file) << "a preset";
    state.files.preset_path = file.string();
    editor.model().fulfil(save);
    EXPECT_NE(state.log.lines().back().text.find("name another file"), std::string::npos);
    editor.settle();
    EXPECT_EQ(file_bytes(file), "a preset") << "the open preset was replaced";
}

/// Returns the pixels of a column range of the scene picture, without its upper fifth, where labels are.
std::vector<std::uint8_t> part(const HeadlessEditor& editor, const PictureView& view, double from, double to) {
    const ByteImage image = editor.picture();
    std::vector<std::uint8_t> out;
    const int x0 = int(view.origin.x + from * view.size.x), x1 = int(view.origin.x + to * view.size.x);
    for (int y = int(view.origin.y + 0.2 * view.size.y); y < int(view.origin.y + 0.8 * view.size.y); ++y) {
        const auto* row = &image.data[(std::size_t(y) * std::size_t(image.width) + std::size_t(x0)) * 4];
        out.insert(out.end(), row, row + std::size_t(x1 - x0) * 4);
    }
    return out;
}

SI_TEST_IS(Later, EditorPictureComparison, SwipeShowsBothSidesAndIsDragged);
TEST(EditorPictureComparison, SwipeShowsBothSidesAndIsDragged) {
    test::TestEditor editor(options({"bias.kind=constant", "bias.constant=0", "bias.normal=0", "filter.kernel=hard",
                                     "view.frustum=false", "view.axes=false", "map.resolution=256"}));
    EditorState& state = editor.state();
    state.comparison = {.view = ComparisonView::Swipe, .reference = true, .at = 1};
    editor.settle();
    ASSERT_TRUE(editor.model().facts().picture_comparison &&
                editor.model().facts().picture_comparison->picture.texture);
    ASSERT_TRUE(state.viewport.view);
    const PictureView view = *state.viewport.view;
    const auto left_a = part(editor, view, 0.05, 0.4), right_a = part(editor, view, 0.6, 0.95);
    state.comparison.at = 0;
    editor.settle();
    const auto left_b = part(editor, view, 0.05, 0.4), right_b = part(editor, view, 0.6, 0.95);
    EXPECT_NE(left_a, left_b);
    EXPECT_NE(right_a, right_b);
    state.comparison.at = 0.3f;

    // The line is dragged from 0.3 to the middle; the camera stays.
    const CameraSettings camera = state.settings.camera;
    const auto at = [&](double share) {
        return glm::vec2(view.origin.x + share * view.size.x, view.origin.y + 0.7 * view.size.y);
    };
    editor.drag({at(0.3), at(0.35), at(0.42), at(0.5)});
    editor.mouse.at.reset();
    editor.settle();
    EXPECT_NEAR(state.comparison.at, 0.5, 0.01);
    EXPECT_EQ(state.settings.camera, camera);
    EXPECT_FALSE(state.probe_pixel) << "a drag is no click";
    EXPECT_EQ(part(editor, view, 0.05, 0.4), left_a);
    EXPECT_EQ(part(editor, view, 0.6, 0.95), right_b);
    write_png(kOut / "editor_swipe.png", editor.picture());

    // A drag elsewhere orbits the camera as usual.
    editor.drag({at(0.8), at(0.9)});
    EXPECT_NEAR(state.comparison.at, 0.5, 0.01);
    EXPECT_NE(state.settings.camera, camera);
    editor.key('.');
    EXPECT_NEAR(state.comparison.at, 0.52, 0.01);
    editor.key(',');
    EXPECT_NEAR(state.comparison.at, 0.5, 0.01);
    editor.key('B');
    EXPECT_EQ(state.comparison.view, ComparisonView::SideBySide);
    editor.key('B');
    editor.key('B');
    EXPECT_EQ(state.comparison.view, ComparisonView::Off);
    expect_calm(editor);
}

SI_TEST_IS(Later, EditorPictureComparison, ComparesWithPresetsInAllViews);
TEST(EditorPictureComparison, ComparesWithPresetsInAllViews) {
    HeadlessEditor editor(options({"filter.kernel=hard", "map.resolution=128", "view.frustum=false"}));
    EditorState& state = editor.model().state;
    state.comparison = {.view = ComparisonView::SideBySide, .reference = false};
    state.compare = {CompareKind::Defaults, {}};
    editor.settle();
    const auto facts = [&] { return editor.model().facts().picture_comparison; };
    ASSERT_TRUE(facts() && facts()->picture.texture);
    EXPECT_EQ(facts()->picture.width, editor.model().facts().result->colour.width) << "both sides are of one size";
    write_png(kOut / "editor_beside.png", editor.picture());
    state.comparison.view = ComparisonView::Difference;
    editor.settle();
    ASSERT_TRUE(facts()->difference.texture);
    const double different = facts()->mae;
    EXPECT_GT(different, 1e-4);
    write_png(kOut / "editor_difference.png", editor.picture());
    state.comparison.view = ComparisonView::Off;
    editor.settle();
    EXPECT_FALSE(facts());
    state.comparison.view = ComparisonView::Difference;
    editor.settle();
    expect_calm(editor);
    // Light, maps and kernel by the defaults: only rounding of the shading differs.
    state.settings.filter = {};
    state.settings.map = {};
    state.settings.bias = {};
    state.settings.lights = Settings{}.lights;
    state.settings.shading = {};
    state.settings.caster = {};
    editor.settle();
    EXPECT_EQ(facts()->mae, 0);
    state.compare = {CompareKind::Preset, "no such preset"};
    editor.settle();
    EXPECT_FALSE(facts()->problem.empty());
    EXPECT_EQ(facts()->picture.texture, 0u);
}

SI_TEST_IS(Later, EditorPictureComparison, BothSidesHaveMapsOfTheFrozenCamera);
TEST(EditorPictureComparison, BothSidesHaveMapsOfTheFrozenCamera) {
    HeadlessEditor editor(
        options({"light.cascades=3", "filter.kernel=hard", "map.resolution=128", "view.frustum=false"}));
    editor.settle();
    EditorState& state = editor.model().state;
    const auto facts = [&] { return editor.model().facts().picture_comparison; };
    pin_settings(state);
    state.frozen = frozen_camera_of(*editor.model().facts().result, state.settings.camera);
    state.settings.camera.source = CameraSource::Manual;
    state.settings.camera.distance = 9;
    state.settings.camera.azimuth += 120;
    state.compare = {CompareKind::Pinned, {}};
    state.comparison = {.view = ComparisonView::Difference, .reference = false};
    editor.settle();
    ASSERT_TRUE(facts() && facts()->difference.texture);
    EXPECT_EQ(facts()->mae, 0);
    state.frozen.reset();
    editor.settle();
    ASSERT_TRUE(facts() && facts()->difference.texture);
    EXPECT_EQ(facts()->mae, 0) << "the pinned side is drawn again, too";
}

SI_TEST_IS(Later, EditorPictureComparison, PinIsFlickeredAndCompared);
TEST(EditorPictureComparison, PinIsFlickeredAndCompared) {
    test::TestEditor editor(options({"filter.kernel=hard", "map.resolution=128", "view.frustum=false"}));
    EditorState& state = editor.state();
    const auto key = [&](int code, bool down) {
        ImGui::GetIO().KeysDown[code] = down;
        editor.frames(3);
    };
    const auto seen = [&] { return part(editor, *state.viewport.view, 0.05, 0.95); };
    key('A', true);
    EXPECT_FALSE(state.flicker) << "nothing is pinned";
    key('A', false);
    const auto pinned = seen();
    key('P', true);
    key('P', false);
    ASSERT_TRUE(state.pinned);
    EXPECT_EQ(seen(), pinned);
    state.settings.map.resolution = 1024;
    editor.settle();
    const auto changed = seen();
    ASSERT_NE(changed, pinned);

    const PictureComparison before = state.comparison;
    for (int round = 0; round < 2; ++round) {
        key('A', true);
        EXPECT_EQ(seen(), pinned) << "while it is held";
        if (round == 0) write_png(kOut / "editor_flicker.png", editor.picture());
        key('A', false);
        EXPECT_EQ(seen(), changed);
        EXPECT_EQ(state.comparison.view, before.view);
        EXPECT_EQ(state.comparison.reference, before.reference);
    }
    EXPECT_EQ(state.settings.map.resolution, 1024) << "it shows settings and sets none";
    EXPECT_EQ(state.history.index(), 1u);

    state.compare = {CompareKind::Pinned, {}};
    state.comparison = {.view = ComparisonView::Swipe, .reference = false, .at = 0};
    editor.settle();
    EXPECT_EQ(part(editor, *state.viewport.view, 0.05, 0.9), [&] {
        key('A', true);
        const auto alone = part(editor, *state.viewport.view, 0.05, 0.9);
        key('A', false);
        return alone;
    }());
    state.comparison.at = 0.5f;
    editor.settle();
    write_png(kOut / "editor_pin_swipe.png", editor.picture());
    state.window.open_page = Page::Compare;
    editor.settle();
    ASSERT_TRUE(editor.model().facts().comparison);
    EXPECT_EQ(editor.model().facts().comparison->settings.map.resolution, 128);

    state.settings = state.pinned->settings;
    editor.settle();
    key('P', true);
    key('P', false);
    EXPECT_FALSE(state.pinned);
    EXPECT_EQ(state.comparison.view, ComparisonView::Off) << "with what it was compared is gone";
    expect_calm(editor);
}

// Light maps are baked in parallel to frames; maps of another light are not shown.
SI_TEST_IS(Later, EditorLightMap, IsBakedInTheBackgroundAndAgainAfterLightMoves);
TEST(EditorLightMap, IsBakedInTheBackgroundAndAgainAfterLightMoves) {
    HeadlessEditor editor(options({"light.source=light-map", "light_map.resolution=256", "view.frustum=false"}));
    const auto need = [&] { return editor.model().facts().result->light_maps.at(0); };
    editor.settle();
    EXPECT_TRUE(need().met);
    EXPECT_TRUE(editor.model().facts().reference->current);
    const ByteImage first = editor.picture();
    write_png(kOut / "editor_light_map.png", first);

    EditorState& state = editor.model().state;
    state.settings.camera.azimuth += 30;
    editor.frame();
    EXPECT_TRUE(need().met) << "a camera asks for nothing";
    state.settings.camera.azimuth -= 30;

    state.settings.lights[0].azimuth += 40;
    editor.frame();
    EXPECT_FALSE(need().met);
    EXPECT_TRUE(editor.model().facts().reference->lacks_light_map);
    editor.settle();
    EXPECT_TRUE(need().met);
    EXPECT_FALSE(editor.model().facts().reference->lacks_light_map);
    EXPECT_NE(editor.picture().data, first.data);
    const std::size_t baked = light_maps().counts().baked;
    state.settings.lights[0].azimuth -= 40;
    editor.settle();
    EXPECT_TRUE(need().met);
    EXPECT_EQ(light_maps().counts().baked, baked) << "the first one again";
    expect_calm(editor);
}

// A failed bake of one light does not block the other.
SI_TEST_IS(Later, EditorLightMap, MapsThatDoNotFitAreTriedOnceEach);
TEST(EditorLightMap, MapsThatDoNotFitAreTriedOnceEach) {
    HeadlessEditor editor(options({"light.count=2", "light.1.azimuth=80", "light.source=light-map",
                                   "light.1.source=light-map", "light_map.resolution=16", "view.frustum=false"}));
    editor.settle();
    for (int i = 0; i < 5; ++i) {
        editor.frame();
        editor.settle();
    }
    EXPECT_NE(editor.model().facts().reference->problem.find("light_map.resolution"), std::string::npos)
        << editor.model().facts().reference->problem;
    EXPECT_FALSE(editor.model().tracing());
    int said = 0;
    for (const LogLine& line : editor.model().state.log.lines()) said += line.kind == LogKind::Error ? line.count : 0;
    EXPECT_EQ(said, 2) << "once for each light";
    editor.model().state.settings.light_map.resolution = 256;
    editor.settle();
    for (const LightMapNeed& need : editor.model().facts().result->light_maps) EXPECT_TRUE(need.met);
}

TEST(EditorLightMap, CancelHoldsUntilAChange) {
    // More rays than can be traced before the cancel.
    HeadlessEditor editor(options({"light.source=light-map", "light_map.resolution=2048", "light_map.samples=65536",
                                   "light.size=8", "view.frustum=false"}));
    ASSERT_NO_FATAL_FAILURE(cancel_tracing(editor, "editor_light_map_baking.png"));
    EXPECT_FALSE(editor.model().facts().result->light_maps.at(0).met);
    editor.model().state.settings.light_map = {.resolution = 128, .samples = 1};
    editor.settle();
    EXPECT_TRUE(editor.model().facts().result->light_maps.at(0).met);
}

}  // namespace
}  // namespace si
