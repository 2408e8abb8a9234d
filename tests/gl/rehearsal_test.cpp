// Programs made in the background: the old picture stays meanwhile, and the new one is the bytes of who waited.
#include <epoxy/gl.h>

#include <filesystem>

#include "app/editor/headless_editor.h"
#include "app/editor/rehearsals.h"
#include "renderer/gl/target.h"
#include "renderer/scene/stand_in.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

/// The editor has a context of its own.
class RehearsalTest : public ::testing::Test {
protected:
    static std::unique_ptr<HeadlessEditor> editor_of(bool rehearse, const std::string& scene = "boxes") {
        EditorOptions options;
        options.session.scene = scene;
        options.width = 800, options.height = 600;
        options.headless = true, options.rehearse = rehearse;
        auto editor = std::make_unique<HeadlessEditor>(options);
        editor->settle();
        return editor;
    }
    /// The scene's picture as it is shown.
    static std::vector<std::uint8_t> bytes(const HeadlessEditor& editor) {
        const Image& image = shown(editor).panes.front().picture;
        std::vector<std::uint8_t> out(std::size_t(image.width) * std::size_t(image.height) * 4);
        gl::begin_reading();
        glGetTextureImage(image.texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(out.size()), out.data());
        return out;
    }
    static const FrameResult& shown(const HeadlessEditor& editor) {
        return *const_cast<HeadlessEditor&>(editor).model().facts().result;
    }
};

TEST_F(RehearsalTest, TheOldPictureStaysUntilTheProgramsAreThere) {
    const auto editor = editor_of(true);
    const std::uint64_t before = shown(*editor).contents.parts.front().drawn;
    const std::vector<FrameContents::Part> parts = shown(*editor).contents.parts;
    set_setting(editor->model().state.settings, "filter.kernel", "pcss");
    editor->frame();
    ASSERT_TRUE(editor->model().rehearsing());
    ASSERT_EQ(shown(*editor).contents.parts.size(), parts.size());
    EXPECT_EQ(shown(*editor).contents.parts.front().drawn, before);
    editor->settle();
    EXPECT_FALSE(editor->model().rehearsing());
    bool anew = false;
    for (const FrameContents::Part& p : shown(*editor).contents.parts)
        for (const FrameContents::Part& old : parts) anew |= p.image == old.image && p.drawn != old.drawn;
    EXPECT_TRUE(anew) << "the wanted picture was drawn in the end";
}

TEST_F(RehearsalTest, TheFinalPictureIsThatOfWhoWaits) {
    auto background = editor_of(true);
    std::vector<std::vector<std::uint8_t>> pictures;
    for (const char* kernel : {"pcf5", "vsm"}) {
        set_setting(background->model().state.settings, "filter.kernel", kernel);
        background->settle();
        pictures.push_back(bytes(*background));
    }
    background.reset();  // one at a time
    const auto at_once = editor_of(false);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        set_setting(at_once->model().state.settings, "filter.kernel", i == 0 ? "pcf5" : "vsm");
        at_once->settle();
        EXPECT_TRUE(pictures[i] == bytes(*at_once)) << i;
    }
}

TEST_F(RehearsalTest, WhatIsTakenBackIsNotDrawn) {
    const auto editor = editor_of(true);
    const std::uint64_t before = shown(*editor).contents.parts.front().drawn;
    const Settings settings = editor->model().state.settings;
    set_setting(editor->model().state.settings, "filter.kernel", "evsm4");
    editor->frame();
    ASSERT_TRUE(editor->model().rehearsing());
    editor->model().state.settings = settings;
    editor->frame();
    EXPECT_FALSE(editor->model().rehearsing()) << "the picture shown is the one wanted";
    editor->settle();
    EXPECT_EQ(shown(*editor).contents.parts.front().drawn, before);
}

TEST_F(RehearsalTest, NumbersAloneWaitForNothing) {
    const auto editor = editor_of(true);
    for (const auto& [key, value] : Sets{{"bias.constant", "2.5"}, {"light.azimuth", "77"}, {"light.intensity", "2"}}) {
        set_setting(editor->model().state.settings, key, value);
        editor->frame();
        EXPECT_FALSE(editor->model().rehearsing()) << key;
    }
}

TEST_F(RehearsalTest, WhenAllIsForeseenTheEditorRests) {
    const auto editor = editor_of(true);
    const Rehearsals& rehearsals = *editor->model().rehearsals();
    rehearsals.wait_for_all();
    const std::size_t done = rehearsals.done();
    EXPECT_GT(done, 0u);
    const std::uint64_t drawn = shown(*editor).contents.parts.front().drawn;
    for (int i = 0; i < 5; ++i) editor->frame();
    EXPECT_EQ(shown(*editor).contents.parts.front().drawn, drawn);
    const EditorModel& model = editor->model();
    EXPECT_FALSE(model.loading_moved() || model.measuring_moved() || model.tracing_moved())
        << "nothing calls for a frame";
    rehearsals.wait_for_all();
    EXPECT_EQ(rehearsals.done(), done);
}

class StandInTest : public FrameTest {};

/// Which programs a frame is made of, said by who makes them.
TEST_F(StandInTest, AStandInCallsForTheProgramsOfItsScene) {
    std::vector<std::string> names = {"stage", "boxes", "landscape"};
    for (const char* file : {"gen_forest_10k/forest_10k.glb", "gen_leaf_mask_uv1/leaf_mask_uv1.glb"}) {
        const auto path = std::filesystem::path(SI_SOURCE_DIR "/../shared/models") / file;
        if (std::filesystem::exists(path)) names.push_back(path.string());
    }
    const FrameRequest small_frame = small();
    for (const std::string& name : names) {
        const Scene scene = load_scene(name);
        const Settings s = settings_for(scene, {{"filter.kernel", "pcf3"}});
        const Scene small = stand_in(scene, s);
        EXPECT_LT(glm::distance(small.bounds.lo, scene.bounds.lo), 0.05 * scene.bounds.radius()) << name;
        EXPECT_LT(glm::distance(small.bounds.hi, scene.bounds.hi), 0.05 * scene.bounds.radius()) << name;
        EXPECT_LE(small.triangle_count(), std::max<std::size_t>(scene.triangle_count(), 20000)) << name;
        EXPECT_EQ(renderer.programs_key(scene, s, small_frame), renderer.programs_key(small, s, small_frame)) << name;
    }
}

TEST_F(StandInTest, AStandInOfALargeSceneIsSmallAndKeepsEachKind) {
    Scene scene;
    const int plain = add_material(scene, "plain", {1, 0, 0}), cut = add_material(scene, "cut", {0, 1, 0});
    scene.materials[std::size_t(cut)].alpha = AlphaMode::Mask;
    const int node = add_node(scene, "Field");
    const int dense = add_mesh(scene, "dense", make_sphere(1, 200, 100), plain);
    const int leaf = add_mesh(scene, "leaf", make_box(glm::dvec3(1)), cut);
    for (int i = 0; i < 2000; ++i) {
        Object o;
        o.node = node, o.mesh = i == 777 ? leaf : dense;
        o.instance = i == 778 ? scaled(-1, 1, 1) : moved(115 + i % 50, 0, i / 50);
        scene.objects.push_back(o);
    }
    finalise(scene);
    const Scene small = stand_in(scene, {});
    EXPECT_LT(small.triangle_count(), 20000u);
    EXPECT_LT(small.objects.size(), 10u);
    bool masked = false, mirrored = false;
    for (const Object& o : small.objects) {
        masked |= small.meshes[std::size_t(o.mesh)].material == cut;
        mirrored |= glm::determinant(glm::dmat3(o.world)) < 0;
    }
    EXPECT_TRUE(masked);
    EXPECT_TRUE(mirrored);
    EXPECT_NEAR(glm::distance(small.bounds.lo, scene.bounds.lo), 0, 1e-6);
    EXPECT_NEAR(glm::distance(small.bounds.hi, scene.bounds.hi), 0, 1e-6);
}

TEST_F(StandInTest, AnEmptySceneHasAStandIn) {
    Scene nothing;
    finalise(nothing);
    EXPECT_TRUE(stand_in(nothing, {}).objects.empty());
}

}  // namespace
}  // namespace si
