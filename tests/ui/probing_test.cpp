// Tests of the probe in the whole editor: its surface, arrow keys, the loupe, and the artefact tour.
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/base/output.h"
#include "renderer/inspect/probe.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/reference/live_error.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/overlays.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "ui/scene_view/camera_steering.h"

namespace si::test {
namespace {

const std::filesystem::path kOut = SI_TEST_OUTPUT_DIR;

EditorOptions boxes_under(std::vector<std::string> sets) {
    sets.insert(sets.end(), {"view.frustum=false", "map.resolution=256"});
    return editor_options("boxes", sets, {960, 600});
}

struct Probing : TestEditor {
    explicit Probing(std::vector<std::string> sets = {}) : TestEditor(boxes_under(std::move(sets))) {}
    void click(glm::ivec2 pixel) {
        drag({glm::vec2(state().viewport.view->origin) + glm::vec2(pixel) + 0.5f});
        mouse.at.reset();
        settle();
    }
    void arrow(ImGuiKey_ which) {
        ImGui::GetIO().KeyMap[which] = 256 + which;
        key(256 + which);
    }
    const Probe* probe() { return facts().probe; }
};

SI_TEST_IS(Later, Probing, ProbeSticksToItsSurface);
TEST(Probing, ProbeSticksToItsSurface) {
    Probing editor;
    const glm::dvec2 size = editor.state().viewport.view->size;
    editor.click(glm::ivec2(0.5 * size.x + 0.05 * size.y, 0.26 * size.y));  // the cube in the air
    ASSERT_TRUE(editor.probe() && editor.probe()->hit);
    ASSERT_EQ(editor.probe()->object.find("loor"), std::string::npos) << editor.probe()->object;
    const glm::dvec3 at = editor.probe()->position_ws;
    const std::string object = editor.probe()->object;
    const glm::ivec2 before = *editor.state().probe_pixel;

    take_camera(editor.state(), editor.model().facts());
    editor.state().settings.camera.azimuth += 10;
    editor.settle();
    ASSERT_TRUE(editor.probe());
    EXPECT_NE(*editor.state().probe_pixel, before);
    EXPECT_EQ(editor.probe()->object, object);
    const PictureView view{
        editor.probe()->camera, {0, 0}, glm::dvec2(editor.probe()->width, editor.probe()->height), 1};
    EXPECT_LT(glm::distance(editor.probe()->position_ws, at), 6 * view.metres_per_pixel(at));
    EXPECT_EQ(editor.model().facts().anchor_place, AnchorPlace::Seen);

    // Outside the picture nothing is probed, and a message says so; inside again the probe is back.
    const CameraSettings good = editor.state().settings.camera;
    editor.state().settings.camera.target_x += 100;
    editor.settle();
    EXPECT_FALSE(editor.probe());
    EXPECT_EQ(editor.model().facts().anchor_place, AnchorPlace::Outside);
    write_png(kOut / "editor_probe_outside.png", editor.picture());
    editor.state().settings.camera = good;
    editor.settle();
    ASSERT_TRUE(editor.probe());
    EXPECT_LT(glm::distance(editor.probe()->position_ws, at), 6 * view.metres_per_pixel(at));

    // The cube hides its own front from behind.
    editor.state().settings.camera.azimuth += 170;
    editor.settle();
    EXPECT_EQ(editor.model().facts().anchor_place, AnchorPlace::Hidden);
    write_png(kOut / "editor_probe_hidden.png", editor.picture());
    editor.state().probe_pixel = glm::ivec2(40, 40);
    editor.settle();
    EXPECT_EQ(editor.model().facts().anchor_place, AnchorPlace::Seen) << "another pixel was chosen";
    EXPECT_EQ(*editor.state().probe_pixel, glm::ivec2(40, 40));
}

TEST(Probing, PixelBelowThePictureIsClamped) {
    EditorOptions options = boxes_under({});
    options.probe_x = 120;
    options.probe_y = 5000;
    TestEditor editor(options);
    const EditorState& state = editor.state();
    ASSERT_TRUE(editor.facts().probe && state.probe_pixel && state.viewport.view);
    EXPECT_EQ(*state.probe_pixel, glm::ivec2(120, int(state.viewport.view->size.y) - 1)) << "where loupe and mark are";
    EXPECT_EQ(editor.model().facts().probe->y, state.probe_pixel->y);
}

TEST(Probing, ArrowKeysMoveTheProbeAndTheLoupeShowsItsPixels) {
    Probing editor;
    const glm::ivec2 at(310, 62);               // slanted edges of the floating cube are inside the loupe
    const ByteImage window = editor.picture();  // without marks of the probe
    editor.click(at);
    ASSERT_EQ(*editor.state().probe_pixel, at);
    editor.arrow(ImGuiKey_RightArrow);
    editor.arrow(ImGuiKey_DownArrow);
    EXPECT_EQ(*editor.state().probe_pixel, at + 1);
    ASSERT_TRUE(editor.probe());
    EXPECT_EQ(editor.probe()->x, at.x + 1);
    editor.mouse.shift = true;
    editor.arrow(ImGuiKey_LeftArrow);
    editor.mouse.shift = false;
    EXPECT_EQ(*editor.state().probe_pixel, at + glm::ivec2(-9, 1));
    EXPECT_FALSE(editor.state().history.can_undo()) << "it sets nothing";

    const LoupeFacts* loupe = editor.model().facts().loupe;
    ASSERT_TRUE(loupe);
    EXPECT_EQ(loupe->at, *editor.state().probe_pixel);
    const PictureView& view = *editor.state().viewport.view;
    int different = 0;
    for (int y = 0; y < loupe->pixels.height; ++y)
        for (int x = 0; x < loupe->pixels.width; ++x) {
            const glm::ivec2 p = glm::ivec2(view.origin) + loupe->at + glm::ivec2(x, y) - kLoupeRadiusPixels;
            const auto* seen = &window.data[(std::size_t(p.y) * std::size_t(window.width) + std::size_t(p.x)) * 4];
            const auto* large =
                &loupe->pixels.data[(std::size_t(y) * std::size_t(loupe->pixels.width) + std::size_t(x)) * 4];
            different += !std::equal(seen, seen + 3, large);
        }
    EXPECT_EQ(different, 0);
    write_png(kOut / "editor_loupe.png", editor.picture());
    editor.key('G');
    ASSERT_EQ(editor.state().loupe, LoupeMode::Mouse);
    editor.mouse.at = glm::vec2(view.origin) + glm::vec2(300.5f, 100.5f);
    editor.frames(4);
    ASSERT_TRUE(editor.model().facts().loupe);
    EXPECT_EQ(editor.model().facts().loupe->at, glm::ivec2(300, 100));
    EXPECT_TRUE(editor.model().facts().loupe->visibility);
    editor.key('G');
    EXPECT_FALSE(editor.model().facts().loupe);
}

TEST(Probing, WidgetsHaveTheArrowKeysUnlessThePictureIsFocused) {
    UiHarness ui(1280, 720);
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    const auto navigates = [&] { return (io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) != 0; };
    const auto key = [&](ImGuiKey_ which) {
        ui.key(io.KeyMap[which]);
        ui.frame();
    };
    ui.frames(3);
    EXPECT_TRUE(navigates());
    const glm::vec2 picture(ui.state.viewport.view->origin + 0.3 * ui.state.viewport.view->size);
    ui.click(picture);
    ASSERT_TRUE(ui.state.probe_pixel);
    EXPECT_FALSE(navigates());
    const glm::ivec2 at = *ui.state.probe_pixel;
    key(ImGuiKey_LeftArrow);
    EXPECT_EQ(*ui.state.probe_pixel, at - glm::ivec2(1, 0));
    key(ImGuiKey_Tab);
    EXPECT_TRUE(navigates());
    key(ImGuiKey_LeftArrow);
    EXPECT_EQ(*ui.state.probe_pixel, at - glm::ivec2(1, 0));
    ui.click(picture);
    EXPECT_FALSE(navigates());
    ui.click({1100, 600});  // the settings
    EXPECT_TRUE(navigates());
    ui.click(picture);
    key(ImGuiKey_Escape);
    EXPECT_FALSE(ui.state.probe_pixel);
    EXPECT_TRUE(navigates());
}

TEST(Probing, EscapeThatClosesAMenuKeepsTheProbe) {
    UiHarness ui(1280, 720);
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    const auto escape = [&] {
        ui.key(io.KeyMap[ImGuiKey_Escape]);
        ui.frame();
    };
    const auto menu_is_open = [] { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup); };
    ui.frames(3);
    ui.click(glm::vec2(ui.state.viewport.view->origin + 0.3 * ui.state.viewport.view->size));
    ASSERT_TRUE(ui.state.probe_pixel);
    ui.click(ui.find("editor/top", "", "View"));
    ASSERT_TRUE(menu_is_open());
    escape();
    EXPECT_FALSE(menu_is_open());
    EXPECT_TRUE(ui.state.probe_pixel);
    escape();
    EXPECT_FALSE(ui.state.probe_pixel);
}

SI_TEST_IS(Later, Probing, HoveredArtefactIsNamed);
TEST(Probing, HoveredArtefactIsNamed) {
    Probing editor(
        {"bias.kind=constant", "bias.constant=0", "bias.normal=0", "filter.kernel=hard", "view.overlay=artefacts"});
    const PictureView view = *editor.state().viewport.view;
    editor.mouse.at = glm::vec2(view.origin) + glm::vec2(view.size) * 0.5f;
    editor.frames(3);
    editor.settle();
    const FloatImage* values = editor.model().facts().overlay_values;
    ASSERT_TRUE(values);
    const test::DrawnText drawn;
    int acne = 0, right = 0;
    for (int y = values->height / 4; y < values->height - 40 && (acne < 3 || right < 3); y += 7)
        for (int x = 40; x < values->width - 40 && (acne < 3 || right < 3); x += 11) {
            const bool wrong = values->at(x, y, 3) > 0;
            if ((wrong ? acne : right) >= 3) continue;
            editor.mouse.at = glm::vec2(view.origin) + glm::vec2(x, y) + 0.5f;
            editor.frames(2);
            EXPECT_EQ(drawn.shows(std::u32string_view(U"nothingwrong")), !wrong) << x << ", " << y;
            ++(wrong ? acne : right);
        }
    EXPECT_GE(acne, 3);
    EXPECT_GE(right, 3);
}

SI_TEST_IS(Later, ArtefactTour, VisitsClustersAndProbesThem);
TEST(ArtefactTour, VisitsClustersAndProbesThem) {
    Probing editor({"bias.kind=constant", "bias.constant=0", "bias.normal=0", "filter.kernel=hard"});
    EditorState& state = editor.state();
    // The tab *Error* stays open during a tour. The tab *Pixel* would search a fix for each place.
    state.window.open_page = Page::Error;
    editor.settle();
    const Settings before = state.settings;
    editor.key('X');
    editor.settle();
    EXPECT_TRUE(state.shows(Page::Error));
    const ArtefactTour& tour = state.artefact_tour;
    ASSERT_GT(tour.of.spots.size(), 1u);
    for (std::size_t i = 1; i < tour.of.spots.size(); ++i)
        EXPECT_GE(tour.of.spots[i - 1].pixels, tour.of.spots[i].pixels);
    const Artefact cause = state.artefacts.cause;
    EXPECT_EQ(cause, Artefact::Acne) << "most pixels are wrong by it";
    std::vector<glm::dvec3> seen;
    for (int i = 0; i < 2; ++i) {
        if (i > 0) editor.key('X');
        editor.settle();
        const ArtefactSpot& spot = tour.of.spots[std::size_t(i)];
        ASSERT_TRUE(editor.probe() && editor.probe()->hit);
        EXPECT_EQ(editor.model().facts().anchor_place, AnchorPlace::Seen);
        const PictureView view{
            editor.probe()->camera, {0, 0}, glm::dvec2(editor.probe()->width, editor.probe()->height), 1};
        EXPECT_LT(glm::distance(editor.probe()->position_ws, spot.position_ws),
                  0.05 * view.metres_per_pixel(spot.position_ws))
            << "the very point that is wrong";
        ASSERT_FALSE(editor.model().facts().diagnoses.empty());
        EXPECT_EQ(editor.model().facts().diagnoses[0].cause().artefact, cause);
        EXPECT_NEAR(editor.probe()->x, 0.5 * editor.probe()->width, 1.5) << "in the middle of the picture";
        EXPECT_NEAR(editor.probe()->y, 0.5 * editor.probe()->height, 1.5);
        seen.push_back(spot.position_ws);
        EXPECT_TRUE(state.log.lines().back().text.starts_with("At " + artefact_tour_text(state, editor.facts())))
            << "the status bar still says: " << state.log.lines().back().text;
        if (i == 0) write_png(kOut / "editor_next_artefact.png", editor.picture());
    }
    EXPECT_NE(seen[0], seen[1]);
    EXPECT_EQ(state.history.names().back(), "camera");
    Settings same = state.settings;
    same.camera = before.camera;
    EXPECT_EQ(same, before) << "it moves the camera and nothing else";
    EXPECT_EQ(state.history.undo(), before) << "one step";
    state.window.open_page = Page::Log;
    editor.frames(3);
    EXPECT_TRUE(state.shows(Page::Log));
    editor.key('X');
    EXPECT_TRUE(state.shows(Page::Pixel)) << "other tabs make way for the place";
}

TEST(ArtefactTour, AnotherLightAndAReloadedSceneRestartIt) {
    const Scene scene = load_scene("boxes"), reloaded = load_scene("boxes");
    ASSERT_NE(scene.id, reloaded.id);
    EditorState state;
    state.settings.light_count = 2;
    const FrameResult result = made_up_frame(scene, state.settings);
    EditorFrame frame;
    frame.result = &result;
    ArtefactTour& tour = state.artefact_tour;
    const auto visit_first = [&] {
        tour = {};
        tour.of = {.number = 1, .spots = std::vector<ArtefactSpot>(2), .camera = result.camera, .height = 90};
        tour.left = state.settings;
        tour.scene = scene.id;
        frame.scene = &scene;
    };
    visit_first();
    state.settings.view.overlay = 1;
    next_artefact(state, frame);
    EXPECT_EQ(tour.waits_for, 0) << "display aids do not matter";
    EXPECT_EQ(tour.at, 1u);
    EXPECT_NE(artefact_tour_text(state, frame), "");
    state.settings.view.light = 1;
    EXPECT_EQ(artefact_tour_text(state, frame), "");
    next_artefact(state, frame);
    EXPECT_NE(tour.waits_for, 0) << "clusters of the other light";
    visit_first();
    frame.scene = &reloaded;
    next_artefact(state, frame);
    EXPECT_NE(tour.waits_for, 0) << "clusters of the scene as it was";
}

TEST(ArtefactTour, SwatchSelectsTheCauseAndShowsIt) {
    UiHarness ui(1600, 900);
    ui.state.window.open_page = Page::Error;
    ui.state.layout.bottom_height = 17;
    ui.reference = ReferenceFacts{.current = true, .wanted = true};
    LiveError e;
    e.metrics.counted = 1000;
    e.metrics.artefacts[std::size_t(Artefact::Leak)] = 7;
    ui.error = e;
    ui.frames(4);
    const ArtefactStyle& style = artefact_styles()[1];
    toggle_tour_cause(ui.state, style.artefact);
    ui.frames(2);
    ASSERT_GT(ui.state.settings.view.overlay, 0);
    EXPECT_TRUE(overlays()[std::size_t(ui.state.settings.view.overlay - 1)].names_causes);
    toggle_tour_cause(ui.state, style.artefact);
    EXPECT_EQ(ui.state.settings.view.overlay, 0);
    EXPECT_FALSE(ui.state.artefact_tour.cause);
    // With the mouse: some row of the tables.
    bool clicked = false;
    for (float y = float(ui.height()) - 250; y < float(ui.height()) - 40 && !clicked; y += 6)
        for (const float x : {700.f, 850.f}) {
            ui.click({x, y});
            if ((clicked = ui.state.artefact_tour.cause.has_value())) break;
        }
    EXPECT_TRUE(clicked);
    EXPECT_GT(ui.state.settings.view.overlay, 0);
}

}  // namespace
}  // namespace si::test
