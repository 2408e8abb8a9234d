// Tests of scene loading in the background. The tests control the reader, so nothing depends on the machine's speed.
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/session/command_line.h"
#include "app/session/presets.h"
#include "app/session/scene_loading.h"
#include "renderer/base/error.h"
#include "renderer/gltf/gltf.h"
#include "renderer/scene/placement.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "tests/unit/gltf_test_file.h"
#include "ui/state/panels.h"
#include "ui/state/scene_choices.h"

namespace si {
namespace {

using namespace std::chrono_literals;

/// Reader that the test advances. Any name but "plane" reads "boxes".
class Puppet {
public:
    SceneReader reader() {
        return [this](const std::string& name, const GltfOptions& options) { return read(name, options); };
    }
    /// Returns once the reader has reported this progress.
    void advance(double progress) {
        std::unique_lock lock(mutex_);
        wanted_ = progress;
        EXPECT_TRUE(changed_.wait_for(lock, 60s, [&] { return reported_ == progress; })) << "nobody reads";
    }
    void release(const std::string& error = {}) {
        const std::lock_guard lock(mutex_);
        released_ = true;
        error_ = error;
    }
    std::vector<std::string> started() const { return locked(started_); }
    std::vector<std::string> cancelled() const { return locked(cancelled_); }
    int most_at_once() const { return locked(most_); }

private:
    template <class T>
    T locked(const T& value) const {
        const std::lock_guard lock(mutex_);
        return value;
    }
    Scene read(const std::string& name, const GltfOptions& options) {
        if (name == "plane") return load_scene(name);
        std::unique_lock lock(mutex_);
        started_.push_back(name);
        most_ = std::max(most_, ++reading_);
        bool finished = false;
        // A limit of one minute: an editor that never cancels fails its test instead of hanging it.
        for (const auto end = std::chrono::steady_clock::now() + 60s; std::chrono::steady_clock::now() < end;) {
            if (!options.progress(wanted_)) {
                cancelled_.push_back(name);
                break;
            }
            reported_ = wanted_;
            changed_.notify_all();
            if (finished = released_; finished) break;
            changed_.wait_for(lock, 1ms);
        }
        --reading_;
        if (!finished) throw Error("cancelled");
        if (!error_.empty()) throw Error(error_);
        return load_scene("boxes");
    }

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    double wanted_ = 0, reported_ = -1;
    bool released_ = false;
    std::string error_;
    std::vector<std::string> started_, cancelled_;
    int reading_ = 0, most_ = 0;
};

std::string last_line(HeadlessEditor& editor) {
    return editor.model().state.log.lines().back().text;
}

/// Editor that shows "plane" and reads `name` with the controlled reader.
struct Loading {
    Puppet puppet;  // outlives the editor, whose thread uses it
    HeadlessEditor editor{test::editor_options("plane"), puppet.reader()};
    EditorModel& model = editor.model();
    EditorState& state = model.state;

    explicit Loading(const std::string& name = "city.gltf") {
        editor.settle();
        EditorRequests requests = editor.frame();
        requests.load_scene = name;
        model.fulfil(requests);
    }
    void cancel() {
        EditorRequests requests = editor.frame();
        requests.cancel_load = true;
        model.fulfil(requests);
    }
    std::optional<LoadingFacts> facts() { return model.facts().loading; }
    const std::string& shown() { return state.scene_name; }
};

TEST(Loading, EditorDrawsTheOldSceneAndTheProgress) {
    Loading l;
    EditorModel& model = l.editor.model();
    ByteImage before;
    double last = -1;
    for (const double progress : {0.1, 0.43, 0.9}) {
        l.puppet.advance(progress);
        EXPECT_TRUE(model.loading_moved()) << "a window would sleep on";
        l.editor.frame();
        ASSERT_TRUE(l.facts());
        EXPECT_EQ(l.facts()->name, "city.gltf");
        EXPECT_EQ(l.facts()->progress, progress);
        EXPECT_GT(l.facts()->progress, last);
        last = progress;
        EXPECT_FALSE(model.loading_moved()) << "nothing is new";
        const ByteImage picture = l.editor.picture();
        EXPECT_NE(picture.data, before.data) << "the progress is seen";
        before = picture;
    }
    const std::uint64_t scene = model.facts().scene->id;
    model.state.settings.view.overlay = 2;  // the old scene is still in use
    l.editor.frame();
    ASSERT_TRUE(model.facts().result);
    EXPECT_NE(model.facts().result->overlay.texture, 0u);
    EXPECT_EQ(l.shown(), "plane");

    l.puppet.release();
    l.editor.settle();
    EXPECT_EQ(l.shown(), "city.gltf");
    EXPECT_NE(model.facts().scene->id, scene);
    EXPECT_EQ(model.facts().scene->objects.size(), load_scene("boxes").objects.size());
    EXPECT_FALSE(l.facts());
    EXPECT_FALSE(model.loading());
    EXPECT_EQ(model.state.settings.view.overlay, 2);
}

TEST(Loading, CancelKeepsTheShownScene) {
    Loading l;
    l.puppet.advance(0.5);
    const Settings before = l.state.settings;
    l.cancel();
    EXPECT_FALSE(l.facts()) << "at once, not when the reader notices";
    EXPECT_EQ(last_line(l.editor), "Cancelled: city.gltf was not loaded");
    l.model.finish_loading();
    EXPECT_EQ(l.puppet.cancelled(), std::vector<std::string>{"city.gltf"});
    l.editor.settle();
    EXPECT_EQ(l.shown(), "plane");
    EXPECT_EQ(l.state.settings, before);
    EXPECT_EQ(l.state.log.unseen_errors(), 0) << last_line(l.editor);
}

TEST(Loading, SceneReadBeforeItsCancelIsDropped) {
    Puppet puppet;
    puppet.release();
    SceneLoading loading(puppet.reader());
    loading.start("late.gltf");
    loading.wait();
    loading.cancel();
    EXPECT_FALSE(loading.poll());
    EXPECT_FALSE(loading.busy());
}

TEST(Loading, FailureKeepsTheSceneAndIsALineInTheLog) {
    Loading l;
    l.puppet.advance(0.7);
    l.puppet.release("city.gltf: it is broken; mend it");
    l.editor.settle();
    EXPECT_EQ(l.shown(), "plane");
    EXPECT_EQ(last_line(l.editor), "city.gltf: it is broken; mend it");
    EXPECT_EQ(l.state.log.lines().back().kind, LogKind::Error);
    EXPECT_TRUE(l.state.shows(Page::Log));
    EXPECT_TRUE(l.model.facts().result);
    EXPECT_FALSE(l.facts());
}

TEST(Loading, SecondRequestCancelsTheFirst) {
    Loading l("first.gltf");
    l.puppet.advance(0.5);
    l.model.open("second.gltf");
    l.model.open("third.gltf");
    ASSERT_TRUE(l.facts());
    EXPECT_EQ(l.facts()->name, "third.gltf");
    EXPECT_EQ(l.facts()->progress, 0);
    l.puppet.release();
    l.editor.settle();
    EXPECT_EQ(l.shown(), "third.gltf");
    const std::vector<std::string> both{"first.gltf", "third.gltf"};
    EXPECT_EQ(l.puppet.started(), both);
    EXPECT_EQ(l.puppet.most_at_once(), 1) << "two scenes would be in memory";
}

TEST(Loading, ClosingTheEditorCancelsAndJoinsTheThread) {
    Puppet puppet;
    {
        HeadlessEditor editor(test::editor_options("plane"), puppet.reader());
        editor.settle();
        editor.model().open("city.gltf");
        puppet.advance(0.2);
    }
    EXPECT_EQ(puppet.cancelled(), std::vector<std::string>{"city.gltf"});
}

TEST(Loading, PresetWaitsForItsSceneAndIsCancelledWithIt) {
    const std::filesystem::path file = std::filesystem::path(SI_TEST_OUTPUT_DIR) / "loading_preset.json";
    Preset preset{.about = {}, .scene = "town.gltf", .settings = {}};
    preset.settings.bias.constant = 3.25;
    save_preset(preset, file);
    Loading l;
    l.puppet.advance(0.5);
    const double bias = l.state.settings.bias.constant;
    const std::string saved_to = l.state.files.preset_path;
    l.model.open(file);
    EXPECT_EQ(l.facts()->name, "town.gltf");
    l.cancel();
    l.model.finish_loading();
    EXPECT_EQ(l.state.settings.bias.constant, bias);
    EXPECT_EQ(l.state.files.preset_path, saved_to) << "saving would replace a preset that is not shown";
    l.model.open(file);
    l.puppet.release();
    l.editor.settle();
    EXPECT_EQ(l.shown(), "town.gltf");
    EXPECT_EQ(l.state.settings.bias.constant, 3.25);
    EXPECT_EQ(l.state.files.preset_path, file.string());
}

TEST(Loading, FirstSceneIsReadOnceWhileTheEditorDraws) {
    Puppet puppet;
    HeadlessEditor editor(test::editor_options("city.gltf", {"bias.constant=2"}), puppet.reader());
    EditorModel& model = editor.model();
    ByteImage before;
    for (const double progress : {0.2, 0.6}) {
        puppet.advance(progress);
        EXPECT_TRUE(model.loading_moved()) << "a window would sleep on";
        editor.frame();
        ASSERT_TRUE(model.facts().loading);
        EXPECT_EQ(model.facts().loading->progress, progress);
        EXPECT_EQ(model.facts().scene, nullptr);
        const ByteImage picture = editor.picture();
        EXPECT_NE(picture.data, before.data) << "the progress is seen";
        before = picture;
    }
    EXPECT_EQ(model.state.settings.bias.constant, 2);
    model.state.settings.map.resolution = 512;  // the panels work already
    puppet.release();
    editor.settle();
    EXPECT_EQ(puppet.started(), std::vector<std::string>{"city.gltf"});
    ASSERT_TRUE(model.facts().result);
    EXPECT_EQ(model.state.scene_name, "city.gltf");
    Settings expected = base_settings(load_scene("boxes"));
    expected.bias.constant = 2;
    expected.map.resolution = 512;
    EXPECT_EQ(model.state.settings, expected);
    EXPECT_FALSE(model.state.history.can_undo());
    EXPECT_NO_THROW(model.require_scene());
}

TEST(Loading, FailedFirstSceneLeavesAWorkingEditor) {
    Puppet puppet;
    puppet.release("city.gltf: it is broken; mend it");
    HeadlessEditor editor(test::editor_options("city.gltf"), puppet.reader());
    editor.settle();
    EditorModel& model = editor.model();
    EXPECT_EQ(model.facts().problem, "city.gltf: it is broken; mend it");
    EXPECT_EQ(model.state.log.lines().back().kind, LogKind::Error);
    EXPECT_TRUE(model.state.shows(Page::Log));
    EXPECT_FALSE(model.facts().result);
    EXPECT_THROW(model.require_scene(), Error);
    // Keys and buttons that need a scene have no effect.
    EditorRequests requests = editor.frame();
    requests.copy_command_line = true;
    model.fulfil(requests);
    editor.mouse.at = glm::vec2(270, 330);
    editor.mouse.left = true;
    editor.frame();
    editor.mouse.left = false;
    editor.frame();
    model.open("plane");
    editor.settle();
    EXPECT_TRUE(model.facts().result);
    EXPECT_TRUE(model.facts().problem.empty());
    EXPECT_EQ(model.state.scene_name, "plane");
    EXPECT_NO_THROW(model.require_scene());
}

TEST(Loading, CancelledFirstSceneIsReported) {
    Puppet puppet;
    HeadlessEditor editor(test::editor_options("city.gltf"), puppet.reader());
    puppet.advance(0.3);
    EditorRequests requests = editor.frame();
    requests.cancel_load = true;
    editor.model().fulfil(requests);
    editor.settle();
    EXPECT_EQ(editor.model().facts().problem, "Cancelled: city.gltf was not loaded");
    EXPECT_EQ(editor.model().state.log.unseen_errors(), 0);
}

TEST(Loading, ObjectsMissingInTheFirstSceneAreDroppedAndReported) {
    EditorOptions o = test::editor_options("boxes", {"object.Nobody.cast=false", "bias.constant=2"});
    {
        test::TestEditor editor(o);
        EXPECT_TRUE(editor.facts().result);
        EXPECT_TRUE(editor.state().settings.objects.empty());
        EXPECT_EQ(editor.state().settings.bias.constant, 2);
        EXPECT_NE(last_line(editor).find("object.Nobody: boxes has no such node"), std::string::npos);
    }
    o.headless = true;
    HeadlessEditor strict(o);
    strict.settle();
    EXPECT_THROW(strict.model().require_scene(), UsageError);
}

SI_TEST_IS(Later, Loading, SceneIndexReadsAnotherSceneOfTheFile);
TEST(Loading, SceneIndexReadsAnotherSceneOfTheFile) {
    test::TemporaryFolder folder;
    test::GltfFile file;
    file.add_triangle();
    file.json["scenes"][0]["name"] = "one";
    file.json["scenes"].push_back(
        {{"name", "two"}, {"nodes", {file.append("nodes", {{"mesh", 0}}), file.append("nodes", {{"mesh", 0}})}}});
    test::TestEditor editor(test::editor_options(folder.write("two.glb", file.glb()).string()));
    EditorModel& model = editor.model();
    const auto objects = [&] {
        return std::size_t(
            std::ranges::count_if(model.facts().scene->objects, [](const Object& o) { return !o.ground; }));
    };
    EXPECT_EQ(objects(), 1u);
    const NamedValues expected{{-1, "-1: the file's default"}, {0, "0: one"}, {1, "1: two"}};
    EXPECT_EQ(scene_choices(model.facts().scene, "scene.index"), expected);
    model.state.settings.bias.constant = 7;
    model.state.settings.scene.index = 1;
    editor.frame();
    editor.settle();
    EXPECT_EQ(objects(), 2u);
    EXPECT_EQ(model.state.settings.scene.index, 1);
    EXPECT_EQ(model.state.settings.bias.constant, 7);
    model.state.settings = model.state.history.undo();
    editor.frame();
    editor.settle();
    EXPECT_EQ(objects(), 1u) << "undo reads the one before";
    model.state.settings.scene.index = 5;
    editor.frame();
    editor.settle();
    EXPECT_EQ(objects(), 1u);
    EXPECT_EQ(model.state.settings.scene.index, -1) << "what is shown";
    EXPECT_NE(last_line(editor).find("scene 5 does not exist"), std::string::npos) << last_line(editor);
    EXPECT_FALSE(model.loading()) << "it is not tried again and again";
}

/// Returns the bytes of a .glb: a triangle below a spot light. @param height height of the light, metres
std::string spot_model(double height) {
    test::GltfFile file;
    file.add_triangle();
    file.json["extensions"] = {
        {"KHR_lights_punctual", {{"lights", {{{"type", "spot"}, {"spot", test::Json::object()}}}}}}};
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.root({{"translation", {0, height, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return file.glb();
}

SI_TEST_IS(Later, Loading, LengthsOfAScaledSceneDoNotReachTheNextOne);
TEST(Loading, LengthsOfAScaledSceneDoNotReachTheNextOne) {
    const test::TemporaryFolder folder;
    const std::string next = folder.write("next.glb", spot_model(7)).string();
    test::TestEditor editor(test::editor_options(folder.write("first.glb", spot_model(4)).string()));
    Settings& s = editor.state().settings;
    const double distance = s.lights[0].distance;
    ASSERT_GT(distance, 0);
    s.lights[0].contact = 0.25;  // the user's own length
    editor.settle();
    // A drag, as the settings panel carries it.
    for (const double scale : {1.3, 2.1, 3.7, 7.3, 10.0}) {
        const SceneSettings before = s.scene;
        s.scene.scale = scale;
        carry_settings(s, before, s.scene);
        editor.frame();
    }
    editor.settle();
    ASSERT_NEAR(s.lights[0].distance, 10 * distance, 1e-9);
    editor.model().open(next);
    editor.settle();
    EXPECT_NEAR(s.lights[0].contact, 0.25, 1e-9);
    Settings expected = base_settings(load_scene(next));
    expected.lights[0].contact = s.lights[0].contact;
    EXPECT_EQ(s, expected);
}

TEST(Loading, FileIsReadByTheLoaderWithProgress) {
    const std::filesystem::path file = std::filesystem::path(SI_TEST_OUTPUT_DIR) / "loading_boxes.gltf";
    save_gltf(load_scene("boxes"), file);
    SceneLoading loading;
    loading.start(file.string());
    loading.wait();
    EXPECT_EQ(loading.progress(), 1);
    const auto outcome = loading.poll();
    ASSERT_TRUE(outcome && outcome->scene) << (outcome ? outcome->error : "");
    EXPECT_EQ(outcome->scene->triangle_count(), load_scene("boxes").triangle_count());
}

TEST(Loading, RemainingTimeIsEstimatedOnceKnown) {
    EXPECT_EQ(remaining_seconds(0.5, 0.5), 0) << "too early";
    EXPECT_EQ(remaining_seconds(20, 0.01), 0) << "too little";
    EXPECT_DOUBLE_EQ(remaining_seconds(3, 0.25), 9);
    EXPECT_DOUBLE_EQ(remaining_seconds(30, 0.75), 10);
    EXPECT_EQ(remaining_seconds(30, 1), 0);
    EXPECT_EQ(seconds_text(8.2), "9 s");
    EXPECT_EQ(seconds_text(130), "3 min");

    // The strip with the progress has more to draw.
    test::UiHarness ui(1280, 720);
    const auto vertices = [&](const LoadingFacts& facts) {
        ui.loading = facts;
        ui.frames(3);
        return ImGui::GetDrawData()->TotalVtxCount;
    };
    const int without = vertices({"city.gltf", 0.4, 0});
    EXPECT_GT(vertices({"city.gltf", 0.4, 12}), without);
    EXPECT_NE(vertices({"city.gltf", 1, 0}), without) << "then its first picture is drawn";
}

TEST(Loading, CancelButtonIsOverThePicture) {
    test::UiHarness ui(1280, 720);
    const auto cancelled_by_a_click = [&] {
        bool cancelled = false;
        for (float y = 100; y < 150; y += 12)
            for (float x = 10; x < 540; x += 20) {
                ui.move({x, y});
                ui.frame();
                cancelled |= ui.click_here().cancel_load;
            }
        return cancelled;
    };
    ui.frames(3);
    EXPECT_FALSE(cancelled_by_a_click());
    ui.loading = LoadingFacts{"/models/city.gltf", 0.43};
    ui.frames(2);
    const Settings before = ui.state.settings;
    EXPECT_TRUE(cancelled_by_a_click());
    EXPECT_EQ(ui.state.settings, before);
    ui.with_facts = false;  // a strip without a picture
    EXPECT_TRUE(cancelled_by_a_click());
}

}  // namespace
}  // namespace si
