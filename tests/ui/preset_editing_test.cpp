// Tests of presets in the editor: stepping, saving, comparing, undo across scenes, and crash recovery.
#include <gtest/gtest.h>
#include <imgui.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/base/output.h"
#include "app/session/autosave.h"
#include "app/session/command_line.h"
#include "app/session/setting_json.h"
#include "renderer/gltf/gltf.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "ui/state/panels.h"
#include "ui/state/playback.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr int kPageUp = 401, kPageDown = 402;

EditorOptions preset_options(const std::string& scene = "boxes") {
    return test::editor_options(scene, {}, {800, 450});
}

TEST(HardCaseScene, HasItsSentenceAndItsNeighbour) {
    test::TestEditor editor(preset_options("hard/grazing"));
    const EditorState& state = editor.state();
    EXPECT_EQ(state.files.guide.key, "hard/grazing");
    EXPECT_FALSE(state.files.guide.about.empty());
    EXPECT_EQ(neighbour_preset(state, editor.facts(), +1), "hard/grazing-fixed");
}

/// Small editor; drawn pictures do not matter here.
class PresetEditing : public testing::Test {
protected:
    void open(const EditorOptions& o = preset_options()) {
        editor_.reset();  // one at a time
        editor_ = std::make_unique<test::TestEditor>(o);
        ImGui::GetIO().KeyMap[ImGuiKey_PageUp] = kPageUp;
        ImGui::GetIO().KeyMap[ImGuiKey_PageDown] = kPageDown;
        editor_->settle();
    }
    EditorModel& model() { return editor_->model(); }
    EditorState& state() { return editor_->model().state; }
    void request(const PresetRequests& requests) {
        EditorRequests all;
        static_cast<PresetRequests&>(all) = requests;
        all.scene_width = 320;
        all.scene_height = 180;
        model().fulfil(all);
        editor_->settle();
    }
    void press(int key) {
        editor_->key(key);
        editor_->settle();
    }
    void undo() {
        si::undo(state());
        editor_->settle();
    }
    void redo() {
        si::redo(state());
        editor_->settle();
    }
    EditorOptions remembering() const {
        EditorOptions o = preset_options();
        o.state_folder = folder_ / "state";
        return o;
    }
    void expect_no_errors() {
        for (const LogLine& line : state().log.lines()) EXPECT_NE(line.kind, LogKind::Error) << line.text;
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }

    const fs::path folder_ = fresh_test_folder();
    std::unique_ptr<test::TestEditor> editor_;
};

SI_TEST_IS(Later, PresetEditing, PageDownWalksThroughTheGuidedPresetsAndPageUpBack);
TEST_F(PresetEditing, PageDownWalksThroughTheGuidedPresetsAndPageUpBack) {
    open();
    const std::vector<BuiltinPreset> all = builtin_presets();
    ASSERT_GT(all.size(), 30u);
    state().window.maximised = Panel::Strip;  // each panel has tests of its own
    int walked = 0;
    for (const BuiltinPreset& p : all) {
        press(kPageDown);
        ASSERT_EQ(state().files.guide.key, p.key);
        EXPECT_EQ(state().files.guide.about, p.about);
        EXPECT_EQ(state().scene_name, p.scene);
        EXPECT_EQ(state().settings, load_preset(p.key).settings) << p.key;
        ++walked;
    }
    EXPECT_EQ(walked, int(all.size()));
    press(kPageDown);
    EXPECT_EQ(state().files.guide.key, all.back().key) << "the walk ends";
    press(kPageUp);
    EXPECT_EQ(state().files.guide.key, all[all.size() - 2].key);
    expect_no_errors();
}

TEST_F(PresetEditing, ForeignFilesAreReplacedOnlyAfterConfirmation) {
    open();
    state().settings.bias.constant = 3;
    std::ofstream(path("mine.json")) << "precious";
    request({.save_preset = path("mine.json"), .save_about = "Mine."});
    ASSERT_TRUE(state().files.replace) << "nobody was asked";
    EXPECT_EQ(file_bytes(path("mine.json")), "precious");
    EXPECT_EQ(state().files.replace->path, path("mine.json"));
    state().files.replace.reset();  // cancelled
    editor_->settle();
    EXPECT_EQ(file_bytes(path("mine.json")), "precious");
    request({.save_preset = path("mine.json"), .save_about = "Mine.", .replace = true});
    EXPECT_EQ(load_preset(path("mine.json")).settings.bias.constant, 3);
    EXPECT_EQ(load_preset(path("mine.json")).about, "Mine.");
    EXPECT_EQ(load_preset(path("mine.json")).scene, "boxes");
    EXPECT_FALSE(model().facts().unsaved);
    // The file is now the editor's own: no question, and its sentence stays.
    state().settings.bias.constant = 4;
    editor_->settle();
    EXPECT_TRUE(model().facts().unsaved);
    request({.save_preset = path("mine.json")});
    EXPECT_FALSE(state().files.replace);
    EXPECT_EQ(load_preset(path("mine.json")).settings.bias.constant, 4);
    EXPECT_EQ(load_preset(path("mine.json")).about, "Mine.");
    expect_no_errors();
}

SI_TEST_IS(Later, PresetEditing, UnsavedSettingsAreOfferedAgainForAnyScene);
TEST_F(PresetEditing, UnsavedSettingsAreOfferedAgainForAnyScene) {
    const auto offered = [&]() -> std::optional<double> {
        const Autosave found(folder_ / "state");
        return found.lost() ? std::optional(found.lost()->preset.settings.bias.constant) : std::nullopt;
    };
    const auto start = [&](const EditorOptions& o) {
        open(o);
        model().write_when_due();
    };
    const auto quit = [&] {
        model().end();
        editor_.reset();
    };
    start(remembering());
    state().settings.bias.constant = 3;
    editor_->settle();
    request({.load_scene = "teapot"});
    ASSERT_EQ(state().settings.bias.constant, 3);
    EXPECT_TRUE(model().facts().unsaved);
    quit();
    EXPECT_EQ(offered(), 3) << "opened another scene";

    EditorOptions other = remembering();
    other.session.scene = "plane";
    start(other);
    request({.restore_lost = true});
    EXPECT_EQ(state().scene_name, "teapot");
    EXPECT_TRUE(model().facts().unsaved);
    quit();
    EXPECT_EQ(offered(), 3) << "restored from another scene";

    start(remembering());
    request({.discard_lost = true});
    state().settings.bias.constant = 5;
    editor_->settle();
    request({.load_scene = "teapot"});
    undo();
    ASSERT_EQ(state().scene_name, "boxes");
    EXPECT_TRUE(model().facts().unsaved);
    quit();
    EXPECT_EQ(offered(), 5) << "undone into the scene before";

    start(remembering());
    request({.discard_lost = true});
    request({.load_scene = "teapot"});
    EXPECT_FALSE(model().facts().unsaved);
    undo();
    EXPECT_FALSE(model().facts().unsaved);
    redo();
    state().settings.camera.azimuth += 10;
    editor_->settle();
    quit();
    EXPECT_EQ(offered(), std::nullopt) << "where one looks is no work";
}

TEST_F(PresetEditing, RevertWithoutASavedPresetSaysWhatToDo) {
    open();
    state().files.preset_path = path("unsaved.json");
    state().settings.bias.constant = 3;
    request({.load_preset = path("unsaved.json")});
    EXPECT_EQ(test::lacking(editor_->last_line(), {"nothing is saved there yet. Save it first (Ctrl+S)"}), "");
    EXPECT_EQ(state().settings.bias.constant, 3);
    request({.save_preset = path("unsaved.json")});
    state().settings.bias.constant = 4;
    request({.load_preset = path("unsaved.json")});
    EXPECT_EQ(state().settings.bias.constant, 3);
}

TEST_F(PresetEditing, OpenedPresetCanBeSavedAndKeepsItsTexts) {
    save_preset({"T", "P", "Look here.", "boxes", {}}, path("told.json"));
    open();
    request({.open_file = path("told.json")});
    EXPECT_EQ(state().files.preset_path, path("told.json"));
    EXPECT_EQ(state().files.guide, (GuideNote{path("told.json"), "T", "Look here."}));
    state().settings.map.resolution = 64;
    request({.save_preset = state().files.preset_path});
    const Preset saved = load_preset(path("told.json"));
    EXPECT_EQ(saved.title, "T");
    EXPECT_EQ(saved.topic, "P");
    EXPECT_EQ(saved.about, "Look here.");
    EXPECT_EQ(saved.settings.map.resolution, 64);
}

TEST_F(PresetEditing, PresetWhoseSceneDoesNotLoadIsNotReplacedBySaving) {
    save_preset({"T", "P", "Look here.", path("missing.gltf"), {}}, path("b.json"));
    const std::string bytes = file_bytes(path("b.json"));
    open(remembering());
    request({.save_preset = path("a.json")});
    request({.load_preset = path("b.json")});
    EXPECT_EQ(state().scene_name, "boxes");
    EXPECT_EQ(state().files.preset_path, path("a.json"));
    ASSERT_EQ(model().facts().recent_presets.size(), 1u);
    EXPECT_EQ(model().facts().recent_presets[0], path("a.json"));
    request({.save_preset = path("b.json")});
    EXPECT_TRUE(state().files.replace) << "nobody was asked";
    EXPECT_EQ(file_bytes(path("b.json")), bytes);
}

TEST_F(PresetEditing, ComparedPresetHasTheShownScene) {
    save_gltf(load_scene("boxes"), folder_ / "own.gltf");
    open(preset_options(path("own.gltf")));
    request({.save_preset = path("p.json")});
    ASSERT_EQ(load_preset(path("p.json")).scene, "own.gltf");
    state().compare = {CompareKind::Preset, path("p.json")};
    state().window.open_page = Page::Compare;
    editor_->settle();
    ASSERT_TRUE(model().facts().comparison);
    EXPECT_EQ(model().facts().comparison->problem, "");
    EXPECT_EQ(model().facts().comparison->scene, state().scene_name);
    request({.load_scene = "plane"});
    EXPECT_EQ(model().facts().comparison->scene, path("own.gltf")) << "a path that opens from anywhere";
}

TEST_F(PresetEditing, PresetNamesItsSceneByAPathThatWorksAnywhere) {
    save_gltf(load_scene("boxes"), folder_ / "own.gltf");
    open(preset_options(path("own.gltf")));
    request({.save_preset = path("with scene.json")});
    EXPECT_EQ(load_preset(path("with scene.json")).scene, "own.gltf") << "beside it";
    fs::create_directory(folder_ / "deep");
    request({.save_preset = path("deep/p.json")});
    EXPECT_EQ(load_preset(path("deep/p.json")).scene, path("own.gltf"));
    state().settings.bias.constant = 9;
    request({.open_file = path("with scene.json")});
    EXPECT_EQ(state().scene_name, path("own.gltf"));
    EXPECT_NE(state().settings.bias.constant, 9);
    EXPECT_FALSE(model().facts().unsaved);
    expect_no_errors();
}

SI_TEST_IS(Later, PresetEditing, DifferencesAreAppliedSinglyAndUndone);
TEST_F(PresetEditing, DifferencesAreAppliedSinglyAndUndone) {
    EditorOptions large = preset_options();
    large.width = 1280;
    large.height = 720;
    open(large);
    state().compare = {CompareKind::Preset, "acne"};
    state().window.open_page = Page::Compare;
    editor_->settle();
    const EditorFrame facts = model().facts();
    ASSERT_TRUE(facts.comparison);
    EXPECT_EQ(facts.comparison->settings, load_preset("acne").settings);
    EXPECT_EQ(facts.comparison->scene, "boxes");
    // The button of the second row: the table shows rows in table order, 22.5 pixels apart.
    const Settings before = state().settings;
    const auto rows = differing_settings(before, facts.comparison->settings);
    ASSERT_GT(rows.size(), 3u);
    for (int y = 500; y < 720 && state().settings == before; y += 6) {
        editor_->mouse.at = glm::vec2(870, y);
        for (const bool down : {false, true, false}) {
            editor_->mouse.left = down;
            editor_->frame();
            editor_->frame();
        }
    }
    const auto left = differing_settings(state().settings, facts.comparison->settings);
    EXPECT_EQ(left.size() + 1, rows.size()) << "one row was taken over";
    editor_->mouse.at.reset();
    editor_->settle();
    undo();
    EXPECT_EQ(state().settings, before);
    write_png(fs::path(SI_TEST_OUTPUT_DIR) / "editor_compare.png", editor_->picture());
}

TEST_F(PresetEditing, ResetAllRestoresSceneSettingsAndIsUndone) {
    open();
    request({.load_preset = "acne"});
    const Settings acne = state().settings;
    request({.reset_all = true});
    EXPECT_EQ(state().settings, base_settings(load_scene("boxes")));
    EXPECT_TRUE(state().files.guide.about.empty());
    undo();
    EXPECT_EQ(state().settings, acne);
    EXPECT_EQ(state().files.guide.key, "acne") << "what was said of it comes back too";
}

TEST_F(PresetEditing, UndoAndRedoWorkAcrossScenes) {
    open();
    const Settings first = state().settings;
    request({.load_preset = "constant-bias"});
    ASSERT_EQ(state().scene_name, "figures");
    state().settings.bias.constant = 0.2;
    editor_->settle();
    undo();
    EXPECT_EQ(state().settings, load_preset("constant-bias").settings);
    undo();
    EXPECT_EQ(state().scene_name, "boxes");
    EXPECT_EQ(state().settings, first);
    EXPECT_TRUE(state().files.guide.key.empty());
    EXPECT_FALSE(state().history.can_undo());
    redo();
    EXPECT_EQ(state().scene_name, "figures");
    EXPECT_EQ(state().settings, load_preset("constant-bias").settings);
    EXPECT_EQ(state().files.guide.key, "constant-bias");
    redo();
    EXPECT_EQ(state().settings.bias.constant, 0.2);
    EXPECT_FALSE(state().history.can_redo());
    expect_no_errors();
}

SI_TEST_IS(Later, PresetEditing, UndoOverAnotherUpAxisKeepsCameraObjectsAndRedo);
TEST_F(PresetEditing, UndoOverAnotherUpAxisKeepsCameraObjectsAndRedo) {
    save_gltf(load_scene("boxes"), folder_ / "turned.gltf");
    open(preset_options(path("turned.gltf")));
    const Settings first = state().settings;
    state().settings.camera.source = CameraSource::Manual;
    state().settings.camera.azimuth += 30;
    editor_->settle();
    const Scene& scene = *model().facts().scene;
    state().settings.objects[scene.nodes[std::size_t(scene.objects.front().node)].path].shown = false;
    editor_->settle();
    const Settings placed = state().settings;
    set_setting(state().settings, "scene.up", "z");
    editor_->settle();
    const Settings turned = state().settings;
    ASSERT_FALSE(turned.camera == placed.camera) << "the turned scene has its own camera";
    undo();
    undo();
    EXPECT_EQ(state().settings, placed);
    EXPECT_FALSE(model().facts().scene->hidden.empty());
    EXPECT_TRUE(state().history.can_redo());
    redo();
    redo();
    EXPECT_EQ(state().settings, turned);
    EXPECT_FALSE(state().history.can_redo());
    while (state().history.can_undo()) undo();
    EXPECT_EQ(state().settings, first);
    EXPECT_FALSE(model().facts().unsaved) << "the settings that the scene began with";
    expect_no_errors();
}

TEST_F(PresetEditing, UndoWithoutItsSceneChangesNothing) {
    save_gltf(load_scene("boxes"), folder_ / "gone.gltf");
    open(preset_options(path("gone.gltf")));
    request({.load_scene = "plane"});
    const Settings now = state().settings;
    fs::remove(folder_ / "gone.gltf");
    undo();
    EXPECT_EQ(state().scene_name, "plane");
    EXPECT_EQ(state().settings, now);
    EXPECT_FALSE(state().between_steps);
    EXPECT_TRUE(state().history.can_undo()) << "and may be tried again";
    EXPECT_FALSE(state().history.can_redo());
}

SI_TEST_IS(Later, PresetEditing, CrashedSessionIsRestoredAndUndone);
TEST_F(PresetEditing, CrashedSessionIsRestoredAndUndone) {
    open(remembering());
    model().write_when_due();
    request({.load_preset = "peter-panning"});
    state().settings.bias.constant = 0.0123;
    editor_->settle();
    model().write_when_due();
    const Settings lost = state().settings;
    open(remembering());  // the previous editor ends without end()
    ASSERT_TRUE(model().facts().lost);
    EXPECT_EQ(model().facts().lost->scene, "figures");
    write_png(fs::path(SI_TEST_OUTPUT_DIR) / "editor_lost_session.png", editor_->picture());
    const Settings fresh = state().settings;
    request({.restore_lost = true});
    EXPECT_EQ(state().scene_name, "figures");
    EXPECT_EQ(state().settings, lost);
    EXPECT_FALSE(model().facts().lost);
    undo();
    EXPECT_EQ(state().scene_name, "boxes");
    EXPECT_EQ(state().settings, fresh);
    model().end();
    open(remembering());
    EXPECT_FALSE(model().facts().lost) << "a clean end leaves nothing";
    expect_no_errors();

    model().write_when_due();
    state().settings.bias.constant = 5;
    model().write_when_due();
    open(remembering());
    ASSERT_TRUE(model().facts().lost);
    request({.discard_lost = true});
    EXPECT_FALSE(model().facts().lost);
    model().end();
    open(remembering());
    EXPECT_FALSE(model().facts().lost) << "a discarded session is deleted";
}

TEST_F(PresetEditing, SessionWithAMissingSceneStaysOffered) {
    save_gltf(load_scene("boxes"), folder_ / "lost.gltf");
    EditorOptions o = remembering();
    o.session.scene = path("lost.gltf");
    open(o);
    model().write_when_due();
    state().settings.bias.constant = 5;
    model().write_when_due();
    fs::rename(folder_ / "lost.gltf", folder_ / "moved.gltf");
    open(remembering());
    request({.restore_lost = true});
    EXPECT_EQ(state().scene_name, "boxes");
    EXPECT_TRUE(model().facts().lost) << "a try that failed threw it away";
    fs::rename(folder_ / "moved.gltf", folder_ / "lost.gltf");
    request({.restore_lost = true});
    EXPECT_EQ(state().settings.bias.constant, 5);
    EXPECT_FALSE(model().facts().lost);
}

SI_TEST_IS(Later, PresetEditing, SessionRestoredAsTheFirstSceneStaysUnsaved);
TEST_F(PresetEditing, SessionRestoredAsTheFirstSceneStaysUnsaved) {
    open(remembering());
    model().write_when_due();
    state().settings.bias.constant = 5;
    model().write_when_due();
    EditorOptions o = remembering();
    o.session.scene = path("missing.gltf");
    open(o);  // the previous editor ends without end()
    ASSERT_FALSE(model().facts().scene);
    request({.restore_lost = true});
    ASSERT_EQ(state().scene_name, "boxes");
    model().write_when_due();
    open(remembering());
    ASSERT_TRUE(model().facts().lost) << "lost by a second crash";
    o = remembering();
    o.session.scene = path("missing.gltf");
    open(o);
    request({.restore_lost = true});
    ASSERT_EQ(state().scene_name, "boxes");
    model().write_when_due();
    model().end();
    const Autosave next(folder_ / "state");
    ASSERT_TRUE(next.lost()) << "lost by quitting";
    EXPECT_EQ(next.lost()->preset.settings.bias.constant, 5);
}

SI_TEST_IS(Later, PresetEditing, LayoutAndRecentFilesPersist);
TEST_F(PresetEditing, LayoutAndRecentFilesPersist) {
    save_gltf(load_scene("boxes"), folder_ / "recent.gltf");
    open(remembering());
    state().layout.map_share = 0.3f;
    request({.load_scene = path("recent.gltf")});
    request({.save_preset = path("recent.json")});
    model().note_window_size(1111, 777, false);
    model().end();
    open(remembering());
    EXPECT_EQ(state().layout.map_share, 0.3f);
    const EditorFrame facts = model().facts();
    ASSERT_EQ(facts.recent_scenes.size(), 1u);
    EXPECT_EQ(facts.recent_scenes[0], path("recent.gltf"));
    ASSERT_EQ(facts.recent_presets.size(), 1u);
    EXPECT_EQ(facts.recent_presets[0], path("recent.json"));
    EXPECT_EQ(Workspace(folder_ / "state").data().window_width, 1111);
    fs::remove(folder_ / "recent.gltf");
    request({.load_scene = path("recent.gltf")});
    EXPECT_TRUE(model().facts().recent_scenes.empty()) << "what is gone is no longer offered";
    open();
    EXPECT_EQ(state().layout, EditorLayout{}) << "without a folder nothing is remembered";
}

TEST_F(PresetEditing, WithoutAStateFolderNothingIsWritten) {
    open();
    model().write_when_due();
    state().settings.bias.constant = 5;
    model().write_when_due();
    model().end();
    EXPECT_TRUE(fs::is_empty(folder_));
}

// The copied command draws the shown picture.
SI_TEST_IS(Later, PresetEditing, CopiedCommandLineDrawsTheSamePicture);
TEST_F(PresetEditing, CopiedCommandLineDrawsTheSamePicture) {
    open();
    for (const char* key : {"acne", "front-culling-exceptions", "ninety-ten", "far-guard", "reversed-depth"}) {
        request({.load_preset = key});
        state().settings.view.frustum = false;
        EditorRequests copy;
        copy.scene_width = 320;
        copy.scene_height = 180;
        model().fulfil(copy);
        copy.copy_command_line = true;
        model().fulfil(copy);
        const std::string command = ImGui::GetClipboardText();
        const std::string program = "shadow-inspector ";
        ASSERT_TRUE(command.starts_with(program)) << command;
        EXPECT_NE(command.find("--size 320x180"), std::string::npos) << command;
        // Through a shell, as a user would; with a report to compare the settings.
        const std::string line = "cd '" + folder_.string() + "' && env -u DISPLAY '" SI_PROGRAM "' " +
                                 command.substr(program.size()) + " --report report.json 2> errors.txt";
        ASSERT_EQ(std::system(line.c_str()), 0) << line << file_bytes(path("errors.txt"));
        const auto report = nlohmann::json::parse(file_bytes(path("report.json")));
        for (const SettingRef& ref : changed_settings(state().settings)) {
            if (ref.param->scope == Scope::Light && ref.light >= state().settings.light_count) continue;
            EXPECT_EQ(report["settings"][setting_key(ref)],
                      nlohmann::json(setting_to_json(ref, get_value(state().settings, ref))))
                << key << " " << setting_key(ref);
        }
        Renderer renderer;
        const FrameRequest request{.width = 320, .height = 180};
        const Scene scene = load_scene(state().scene_name);
        const ByteImage picture = renderer.read_colour(renderer.render(scene, state().settings, request).colour);
        write_png(folder_ / "expected.png", picture);
        EXPECT_EQ(file_bytes(path("out.png")), file_bytes(path("expected.png"))) << key;
    }
}

}  // namespace
}  // namespace si
