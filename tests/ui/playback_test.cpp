// Tests of animation playback: the bar below the pictures, the clock, undo, and animated lights.
#include "ui/state/playback.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <chrono>
#include <optional>

#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "tests/unit/gltf_test_file.h"
#include "ui/state/panels.h"
#include "ui/state/scene_choices.h"
#include "ui/widgets/setting_widgets.h"

namespace si {
namespace {

using test::GltfFile;
using test::Json;

/// Makes a floor and two animations of a node with a sun: "rise" of half a second and "noon" of one key.
GltfFile moving_sun() {
    GltfFile file;
    const int floor = file.floats({-3, 0, -3, -3, 0, 3, 3, 0, 3, -3, 0, -3, 3, 0, 3, 3, 0, -3}, "VEC3");
    file.root({{"name", "floor"}, {"mesh", file.mesh({{"attributes", {{"POSITION", floor}}}})}});
    file.json["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "directional"}, {"name", "sun"}}}}}}};
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    const int sun = file.root({{"name", "sun"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const auto animation = [&](const char* name, const std::vector<float>& times, const std::vector<float>& turns) {
        return Json{{"name", name},
                    {"samplers", {{{"input", file.floats(times, "SCALAR")}, {"output", file.floats(turns, "VEC4")}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", sun}, {"path", "rotation"}}}}}}};
    };
    // From 20 to 70 degrees above the horizon.
    file.json["animations"] = {animation("rise", {0, 0.5f}, {-0.17365f, 0, 0, 0.98481f, -0.57358f, 0, 0, 0.81915f}),
                               animation("noon", {0}, {-0.70711f, 0, 0, 0.70711f})};
    return file;
}

struct Bar {
    test::UiHarness ui{1280, 720};
    Bar() {
        ui.scene = moving_sun().load();
        ui.frames(3);
    }
    /// Returns a point of the bar, `share` of its width from the left.
    static glm::vec2 at(float share) {
        const ImGuiWindow* w = test::UiHarness::window("/time_");
        EXPECT_TRUE(w) << "there is no bar";
        return w ? glm::vec2(w->Pos.x + share * w->Size.x, w->Pos.y + 0.5f * w->Size.y) : glm::vec2(0);
    }
    double time() const { return ui.state.settings.scene.time; }
    EditorRequests space() {
        ImGui::GetIO().KeysDown[' '] = true;
        const EditorRequests requests = ui.frame();
        ImGui::GetIO().KeysDown[' '] = false;
        return requests;
    }
};

TEST(Playback, StaticSceneHasNothingToPlay) {
    test::UiHarness ui(1280, 720);
    ui.frames(3);
    EditorFrame frame;
    frame.scene = &ui.scene;
    EXPECT_EQ(time_bar_height(frame), 0);
    ImGui::GetIO().KeysDown[' '] = true;
    ui.frames(2);
    EXPECT_FALSE(ui.state.playback.playing);
    EXPECT_EQ(ui.state.settings.scene.time, 0);
    const Scene moving = moving_sun().load();
    frame.scene = &moving;
    EXPECT_GT(time_bar_height(frame), 0);
    for (const char* key : {"scene.animation", "scene.time", "scene.fit_animation"}) {
        const SettingRef ref = *find_setting(key);
        SettingFacts facts{.scene = &ui.scene};
        use_setting_facts(&facts);
        EXPECT_EQ(without_effect({}, ref), "without effect: the scene has no animation") << key;
        facts.scene = &moving;
        EXPECT_EQ(without_effect({}, ref), "") << key;
        use_setting_facts(nullptr);
    }
    EXPECT_TRUE(scene_choices(&ui.scene, "scene.animation").empty());
    const NamedValues names = scene_choices(&moving, "scene.animation");
    const NamedValues expected{{-1, "-1: rest pose"}, {0, "0: rise"}, {1, "1: noon"}};
    EXPECT_EQ(names, expected);
    EXPECT_TRUE(scene_choices(&moving, "bias.slope").empty());
}

TEST(Playback, SpacePlaysInRealTimeAsOneUndoStep) {
    Bar bar;
    EXPECT_FALSE(bar.ui.frame().redraw);
    EXPECT_TRUE(bar.space().redraw) << "a window would sleep";
    EXPECT_EQ(bar.time(), 0) << "the time before the key was pressed is not played";
    EXPECT_TRUE(bar.ui.frames(12).redraw);
    EXPECT_NEAR(bar.time(), 12 / 60.0, 1e-6);
    EXPECT_FALSE(bar.ui.state.history.can_undo()) << "frames are no steps";
    bar.space();
    const double stopped = bar.time();
    EXPECT_FALSE(bar.ui.frames(5).redraw);
    EXPECT_EQ(bar.time(), stopped);
    EXPECT_EQ(bar.ui.state.history.undo().scene.time, 0);
    EXPECT_FALSE(bar.ui.state.history.can_undo());
    EXPECT_EQ(bar.ui.state.history.redo().scene.time, stopped);
    EXPECT_FALSE(bar.ui.state.history.can_redo());
}

TEST(Playback, BarHasTheSteadyMapSwitch) {
    Bar bar;
    const auto box = bar.ui.find("/time_", "", "Steady map");
    ASSERT_TRUE(box);
    bar.ui.click(*box);
    EXPECT_TRUE(bar.ui.state.settings.scene.fit_animation);
    EXPECT_FALSE(bar.ui.state.history.undo().scene.fit_animation) << "a step like any other";
    bar.ui.state.settings.scene.animation = -1;
    bar.ui.frames(2);
    bar.ui.click(*box);
    EXPECT_TRUE(bar.ui.state.settings.scene.fit_animation) << "at rest there is nothing to choose";
}

TEST(Playback, LoopsOrStopsAtTheLastKeyAndRestarts) {
    Bar bar;
    bar.ui.state.playback.speed = 2;
    bar.space();
    bar.ui.frames(21);  // 0.7 s of half a second
    EXPECT_NEAR(bar.time(), 0.2, 1e-6);
    bar.ui.state.playback.loop = false;
    bar.ui.frames(30);
    EXPECT_EQ(bar.time(), 0.5);
    EXPECT_FALSE(bar.ui.state.playback.playing);
    EXPECT_EQ(bar.ui.state.history.undo().scene.time, 0) << "all of it is one step";
    bar.ui.state.settings = bar.ui.state.history.redo();
    bar.space();
    bar.ui.frames(3);
    EXPECT_NEAR(bar.time(), 0.1, 1e-6) << "from the start again";
    // An animation of one key, and the rest pose, have no duration.
    for (const int still : {1, -1, 7}) {
        bar.ui.state.settings.scene.animation = still;
        bar.ui.frames(2);
        EXPECT_FALSE(bar.ui.state.playback.playing) << still;
        bar.space();
        EXPECT_FALSE(bar.ui.state.playback.playing) << still;
        bar.ui.frame();
    }
}

TEST(Playback, ChangeDuringPlaybackIsItsOwnUndoStep) {
    Bar bar;
    bar.space();
    bar.ui.frames(6);
    bar.ui.state.settings.bias.constant = 7;
    bar.ui.frames(6);
    undo(bar.ui.state);
    EXPECT_FALSE(bar.ui.state.playback.playing) << "undo stops the clock";
    EXPECT_EQ(bar.ui.state.settings.bias.constant, 7);
    EXPECT_NEAR(bar.time(), 7 / 60.0, 1e-6) << "the moment of the change";
    undo(bar.ui.state);
    EXPECT_EQ(bar.ui.state.settings, Settings{});
    redo(bar.ui.state);
    redo(bar.ui.state);
    EXPECT_NEAR(bar.time(), 12 / 60.0, 1e-6);
}

TEST(Playback, SliderScrubsAndStopsTheClock) {
    Bar bar;
    bar.space();
    bar.ui.frames(2);
    const glm::vec2 middle = bar.at(0.5f);
    bar.ui.drag(middle, middle + glm::vec2(60, 0));
    EXPECT_FALSE(bar.ui.state.playback.playing);
    const double at = bar.time();
    EXPECT_GT(at, 0.01);
    EXPECT_LT(at, 0.49);
    bar.ui.frames(3);
    EXPECT_EQ(bar.time(), at);
    EXPECT_EQ(bar.ui.state.history.undo().scene.time, 0) << "playing and the drag out of it";
}

TEST(Playback, ButtonPlays) {
    Bar bar;
    bar.ui.click(bar.at(0.02f));
    EXPECT_TRUE(bar.ui.state.playback.playing);
    bar.ui.click(bar.at(0.02f));
    EXPECT_FALSE(bar.ui.state.playback.playing);
}

struct Film {
    test::TemporaryFolder folder;
    EditorOptions options;
    Film() { options = test::editor_options(folder.write("sun.glb", moving_sun().glb()).string()); }
};

SI_TEST_IS(Later, Playback, AnimatedLightsAreNoUndoSteps);
TEST(Playback, AnimatedLightsAreNoUndoSteps) {
    Film film;
    test::TestEditor editor(film.options);
    EditorState& state = editor.state();
    const Settings start = state.settings;
    ASSERT_NEAR(start.lights[0].elevation, 20, 0.1);
    EditorFrame facts = editor.facts();
    toggle_play(state, facts);
    const ByteImage before = editor.picture();
    editor.frames(15);
    EXPECT_NEAR(state.settings.lights[0].elevation, 45, 1) << "half way";
    EXPECT_NE(editor.picture().data, before.data);
    EXPECT_FALSE(state.history.can_undo());
    stop_playing(state);
    editor.frames(3);
    const Settings stopped = state.settings;
    undo(state);
    editor.frame();
    EXPECT_EQ(state.settings, start);
    EXPECT_FALSE(state.history.can_undo());
    redo(state);
    editor.frame();
    EXPECT_EQ(state.settings, stopped);
    EXPECT_FALSE(state.history.can_redo());
    // Typed time: the animated light is part of the same step.
    state.settings.scene.time = 0.5;
    editor.frames(3);
    EXPECT_NEAR(state.settings.lights[0].elevation, 70, 0.1);
    undo(state);
    editor.frames(3);
    EXPECT_EQ(state.settings, stopped);
    EXPECT_TRUE(state.history.can_redo()) << "what followed was recorded as new";
    redo(state);
    editor.frames(3);
    EXPECT_NEAR(state.settings.lights[0].elevation, 70, 0.1);
}

SI_TEST_IS(Later, Playback, WorkStartsOnTheSceneAsItsSettingsPoseIt);
TEST(Playback, WorkStartsOnTheSceneAsItsSettingsPoseIt) {
    using Patience = std::optional<std::chrono::milliseconds>;
    for (const Patience patience : {Patience(), Patience(0)}) {
        Film film;
        film.options.frame_patience = patience;
        test::TestEditor editor(film.options);
        const auto exported = [&](const char* name) {
            EditorRequests requests = editor.requests();
            requests.export_file = ExportRequest{ExportKind::Picture, (film.folder.path() / name).string()};
            editor.model().fulfil(requests);
            return file_bytes(film.folder.path() / name);
        };
        const std::string start = exported("start.png");
        editor.state().settings.scene.time = 0.25;
        editor.model().fulfil(editor.requests());  // with a drawing thread, the frame is still under way
        editor.state().settings.scene.time = 0.5;
        const std::string at_once = exported("at_once.png");
        editor.settle();
        EXPECT_TRUE(at_once != start);
        EXPECT_TRUE(at_once == exported("later.png"));
    }
}

SI_TEST_IS(Later, Playback, HeadlessEditorShowsTheTimeOfTheSettings);
TEST(Playback, HeadlessEditorShowsTheTimeOfTheSettings) {
    Film film;
    film.options.session.sets = {"scene.time=0.25"};
    std::vector<ByteImage> pictures;
    for (int i = 0; i < 2; ++i) {
        test::TestEditor editor(film.options);
        editor.frames(i * 9);
        EXPECT_EQ(editor.state().settings.scene.time, 0.25);
        EXPECT_NEAR(editor.state().settings.lights[0].elevation, 45, 1);
        ByteImage picture = editor.picture();
        picture.data.resize(picture.data.size() * 440 / 720);  // the rows below show measured times
        pictures.push_back(std::move(picture));
    }
    EXPECT_EQ(pictures[0].data, pictures[1].data);
}

}  // namespace
}  // namespace si
