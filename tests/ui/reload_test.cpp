// Tests of a scene whose files another program saves: Reload is offered; camera, settings and selection stay. The tests
// give the time and the files' times, so that nothing depends on the machine's speed.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "renderer/gltf/gltf.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/unit/gltf_test_file.h"
#include "ui/state/selection.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTower = "Boxes/Tower";

/// Model file that is saved again and again, each time a second later.
class Reload : public testing::Test {
protected:
    test::TemporaryFolder folder_;
    const fs::path file_ = folder_.path() / "model.gltf";
    const fs::file_time_type first_ = fs::file_time_type::clock::now();
    int saves_ = 0;
    double now_s_ = 100;

    void SetUp() override { save(0); }

    /// Gives a file the time of the next save.
    void stamp(const fs::path& file) { fs::last_write_time(file, first_ + std::chrono::seconds(++saves_)); }
    /// Saves the model with the tower moved along x, metres. @param tower false: without the tower
    void save(double x, bool tower = true) {
        Scene scene = load_scene("boxes");
        for (Node& node : scene.nodes) {
            if (node.path != kTower) continue;
            node.local = glm::translate(glm::dmat4(1), glm::dvec3(x, 0, 0)) * node.local;
            if (!tower) node.name = "House";
        }
        save_gltf(scene, file_);
        stamp(file_);
    }
    /// Writes the first half of the model, as a program that is still writing.
    void save_half() {
        const std::string whole = [&] {
            std::ifstream in(file_, std::ios::binary);
            return std::string(std::istreambuf_iterator<char>(in), {});
        }();
        std::ofstream(file_, std::ios::binary) << whole.substr(0, whole.size() / 2);
        stamp(file_);
    }
    /// Lets the editor look at the files after the shortest time.
    bool look(test::TestEditor& editor) {
        return editor.model().follow_scene_files(now_s_ += SceneWatch::kSeconds * 1.01);
    }
    /// Returns whether the editor offers a reload after some looks.
    bool offers(test::TestEditor& editor) {
        for (int i = 0; i < 3; ++i) look(editor);
        return editor.facts().scene_saved;
    }
    static void reload(test::TestEditor& editor) {
        EditorRequests requests = editor.requests();
        requests.reload_scene = true;
        editor.model().fulfil(requests);
        editor.settle();
    }
    static double tower_x(test::TestEditor& editor) {
        const Bounds box = bounds_of(*editor.facts().scene, std::string(kTower));
        return box.empty() ? -1e9 : box.centre().x;
    }
    test::TestEditor editor() { return test::TestEditor(test::editor_options(file_.string())); }
};

TEST_F(Reload, IsOfferedOnceTheFileIsWrittenAndLooksAreRare) {
    test::TestEditor e = editor();
    EXPECT_FALSE(offers(e));
    now_s_ += 0.2;
    save_half();
    EXPECT_FALSE(e.model().follow_scene_files(now_s_)) << "the look before was less than a second ago";
    EXPECT_FALSE(look(e));
    save(1);
    EXPECT_FALSE(look(e)) << "it grew between two looks";
    EXPECT_FALSE(e.facts().scene_saved);
    EXPECT_TRUE(look(e)) << "the editor has to be drawn again";
    EXPECT_TRUE(e.facts().scene_saved);
    EXPECT_FALSE(look(e)) << "nothing is new";
    reload(e);
    EXPECT_FALSE(e.facts().scene_saved);
    EXPECT_FALSE(offers(e));
}

SI_TEST_IS(Later, Reload, KeepsCameraSettingsAndSelection);
TEST_F(Reload, KeepsCameraSettingsAndSelection) {
    test::TestEditor e = editor();
    EditorState& state = e.state();
    state.settings.bias.slope = 2.5;
    state.settings.objects[kTower].receive = false;
    select_objects(state, std::vector<std::string>{kTower});
    state.probe_pixel = glm::ivec2(300, 200);
    e.settle();
    const Camera camera = e.facts().result->camera;
    const double before = tower_x(e);
    const std::size_t steps = state.history.names().size();
    save(40);  // the automatic camera would frame it
    ASSERT_TRUE(offers(e));
    e.mouse.ctrl = e.mouse.shift = true;
    e.key('R');
    e.mouse.ctrl = e.mouse.shift = false;
    e.settle();
    EXPECT_NEAR(tower_x(e), before + 40, 1e-4);
    EXPECT_EQ(state.settings.bias.slope, 2.5);
    EXPECT_FALSE(state.settings.objects[kTower].receive);
    EXPECT_EQ(selected_objects(state), std::set<std::string>{kTower});
    EXPECT_EQ(state.probe_pixel, glm::ivec2(300, 200));
    EXPECT_EQ(state.history.names().size(), steps) << "no step of undo";
    const Camera after = e.facts().result->camera;
    EXPECT_LT(glm::distance(after.eye, camera.eye), 1e-6 * glm::length(camera.eye));
    EXPECT_LT(glm::distance(after.focus, camera.focus), 1e-6 * glm::length(camera.eye));
    EXPECT_EQ(e.state().log.unseen_errors(), 0) << e.last_line();
}

TEST_F(Reload, LeavesAnUnmovedSceneToTheAutomaticCamera) {
    test::TestEditor e = editor();
    const Settings before = e.state().settings;
    save(0);
    ASSERT_TRUE(offers(e));
    reload(e);
    EXPECT_EQ(e.state().settings, before);
    EXPECT_NE(e.last_line().find("again"), std::string::npos) << e.last_line();
}

TEST_F(Reload, DropsWhatTheSceneNoLongerHas) {
    test::TestEditor e = editor();
    e.state().settings.objects[kTower].cast = false;
    select_objects(e.state(), std::vector<std::string>{kTower});
    e.settle();
    save(0, false);
    ASSERT_TRUE(offers(e));
    reload(e);
    EXPECT_TRUE(selected_objects(e.state()).empty());
    EXPECT_FALSE(e.state().settings.objects.contains(kTower));
    EXPECT_NE(e.last_line().find("has no such node"), std::string::npos) << e.last_line();
}

TEST_F(Reload, FailureKeepsTheSceneAndSaysWhy) {
    test::TestEditor e = editor();
    const std::uint64_t scene = e.facts().scene->id;
    const Settings before = e.state().settings;
    save_half();
    ASSERT_TRUE(offers(e)) << "a file that no longer changes";
    reload(e);
    EXPECT_EQ(e.facts().scene->id, scene);
    EXPECT_EQ(e.state().settings, before);
    EXPECT_EQ(test::lacking(e.last_line(), {"model.gltf", "that was read before is shown"}), "");
    EXPECT_EQ(e.state().log.lines().back().kind, LogKind::Error);
    EXPECT_FALSE(offers(e)) << "until it is saved once more";
    save(1);
    EXPECT_TRUE(offers(e));
    reload(e);
    EXPECT_NE(e.facts().scene->id, scene);
}

TEST_F(Reload, DeletedFileIsNoChangeUntilItComesBack) {
    test::TestEditor e = editor();
    const fs::path aside = folder_.path() / "aside.gltf";
    fs::rename(file_, aside);
    EXPECT_FALSE(offers(e));
    fs::rename(aside, file_);
    EXPECT_FALSE(offers(e)) << "the same file came back";
    fs::remove(file_);
    EXPECT_FALSE(offers(e));
    save(2);
    EXPECT_TRUE(offers(e));
}

TEST_F(Reload, IsNotOfferedAgainOnceTheSceneIsKept) {
    test::TestEditor e = editor();
    save(1);
    ASSERT_TRUE(offers(e));
    EditorRequests requests = e.requests();
    requests.keep_scene = true;
    e.model().fulfil(requests);
    EXPECT_FALSE(offers(e));
    save(2);
    EXPECT_TRUE(offers(e));
}

TEST_F(Reload, FollowsBuffersBesideTheFile) {
    const std::vector<float> triangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::string bytes(reinterpret_cast<const char*>(triangle.data()), triangle.size() * sizeof(float));
    const fs::path buffer = folder_.write("t.bin", bytes);
    stamp(buffer);
    folder_.write("model.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"uri":"t.bin","byteLength":36}]})");
    test::TestEditor e = editor();
    EXPECT_FALSE(offers(e));
    stamp(buffer);
    EXPECT_TRUE(offers(e));
}

TEST_F(Reload, FileThatChangesWhileItIsReadIsNotShown) {
    bool changes = false;
    HeadlessEditor e(test::editor_options(file_.string()), [&](const std::string& name, const GltfOptions& options) {
        Scene scene = load_scene(name, options);
        if (changes) save(3);
        return scene;
    });
    e.settle();
    const std::uint64_t scene = e.model().facts().scene->id;
    changes = true;
    EditorRequests requests = e.frame();
    requests.reload_scene = true;
    e.model().fulfil(requests);
    e.settle();
    EXPECT_EQ(e.model().facts().scene->id, scene);
    EXPECT_NE(e.model().state.log.lines().back().text.find("has changed while it was read"), std::string::npos);
}

TEST(ReloadOfBuiltIn, IsRefusedWithAReason) {
    test::TestEditor e;
    EditorRequests requests = e.requests();
    requests.reload_scene = true;
    e.model().fulfil(requests);
    EXPECT_NE(e.last_line().find("boxes: is built in"), std::string::npos) << e.last_line();
    EXPECT_FALSE(e.model().follow_scene_files(1e6));
}

}  // namespace
}  // namespace si
