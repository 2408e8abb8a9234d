// Tests of the whole editor with the real renderer, drawn through EGL: the shown pictures are the renderer's.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "app/base/output.h"
#include "app/session/command_line.h"
#include "app/session/presets.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"

namespace si {
namespace {

const std::filesystem::path kOut = SI_TEST_OUTPUT_DIR;

using test::editor_options;
using test::expect_calm;
using test::TestEditor;

std::size_t colours_in(const ByteImage& image, int x0, int y0, int x1, int y1) {
    std::set<std::uint32_t> seen;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            const std::uint8_t* p = &image.data[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4];
            seen.insert(std::uint32_t(p[0]) | std::uint32_t(p[1]) << 8 | std::uint32_t(p[2]) << 16);
        }
    return seen.size();
}

class EditorSizes : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(EditorSizes, ShowsSceneMapAndNumbers) {
    const auto [width, height] = GetParam();
    HeadlessEditor editor(editor_options("boxes", {"view.overlay=depth-difference"}, {width, height}));
    editor.model().state.probe_pixel = glm::ivec2(200, 200);
    editor.model().state.window.open_page = Page::Pixel;
    editor.mouse.at = glm::vec2(width / 6, height / 4);  // numbers are read at the mouse position
    editor.settle();
    const ByteImage picture = editor.picture();
    write_png(kOut / ("editor_" + std::to_string(width) + "x" + std::to_string(height) + ".png"), picture);
    const EditorFrame facts = editor.model().facts();
    ASSERT_TRUE(facts.result && facts.probe && facts.overlay_values);
    EXPECT_EQ(facts.result->colour.width, facts.overlay_values->width);
    EXPECT_GT(colours_in(picture, 20, height / 6, width / 3, height / 2), 20u) << "no scene";
    EXPECT_GT(colours_in(picture, width / 2, height / 4, int(width * 0.68), height / 2), 20u) << "no shadow map";
    EXPECT_GT(colours_in(picture, int(width * 0.75), height / 5, width, height), 20u) << "no settings";
    expect_calm(editor);
}

INSTANTIATE_TEST_SUITE_P(Sizes, EditorSizes,
                         testing::Values(std::pair{1280, 720}, std::pair{1920, 1080}, std::pair{3840, 2160}));

TEST(Editor, ShowsThePixelsOfTheRenderer) {
    TestEditor editor(editor_options("boxes", {"view.frustum=false", "view.axes=false"}));
    const ByteImage whole = editor.picture();
    const FrameResult& result = *editor.facts().result;
    Renderer renderer;
    FrameRequest request;
    request.width = result.colour.width;
    request.height = result.colour.height;
    request.with_look = true;
    const Scene scene = load_scene("boxes");
    const ByteImage alone = renderer.read_colour(renderer.render(scene, editor.state().settings, request).colour);
    // Search for the picture near the upper left corner; every bit must match.
    const auto equal_at = [&](int x0, int y0) {
        for (int y = 0; y < alone.height; y += 7)
            for (int x = 0; x < alone.width; x += 7) {
                const std::size_t a = (std::size_t(y) * std::size_t(alone.width) + std::size_t(x)) * 4;
                const std::size_t b = (std::size_t(y + y0) * std::size_t(whole.width) + std::size_t(x + x0)) * 4;
                if (!std::equal(&alone.data[a], &alone.data[a] + 3, &whole.data[b])) return false;
            }
        return true;
    };
    bool found = false;
    for (int y = 30; y < 130 && !found; ++y)
        for (int x = 0; x < 40 && !found; ++x) found = equal_at(x, y);
    EXPECT_TRUE(found);
}

SI_TEST_IS(Later, Editor, DrawsEveryOverlayMapViewLightAndFace);
TEST(Editor, DrawsEveryOverlayMapViewLightAndFace) {
    TestEditor editor(editor_options("boxes", {"map.resolution=512"}, {960, 600}));
    const EditorRequests still = editor.frame();
    EXPECT_FALSE(editor.model().fulfil(still)) << "a still scene is drawn again";
    editor.state().settings.bias.constant += 1;
    EXPECT_TRUE(editor.model().fulfil(still));
    EXPECT_FALSE(editor.model().fulfil(still));

    editor.mouse.at = glm::vec2(150, 200);  // numbers are read at the mouse position
    editor.settle();
    Settings& s = editor.state().settings;
    const std::size_t overlays = find_setting("view.overlay")->param->choices().size();
    for (std::size_t overlay = 0; overlay < overlays; ++overlay) {
        for (int map = 0; map < (overlay == 0 ? 3 : 1); ++map) {
            s.view.overlay = int(overlay);
            s.view.map = MapView((int(overlay) + map) % 3);
            editor.frames(3);
            if (editor.facts().result->panes.front().lacks_reference) editor.settle();
            EXPECT_EQ(editor.facts().overlay_values != nullptr, overlay > 0) << overlay << ", " << map;
        }
    }
    s.view.overlay = 0;
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (int face = 0; face < (type == LightType::Point ? 6 : 1); ++face) {
            s.light_count = 2;
            s.lights[1].type = type;
            s.view.light = 1;
            s.view.face = face;
            editor.frames(3);
            EXPECT_NE(editor.facts().result->map_view.texture, 0u);
        }
    expect_calm(editor);
}

TEST(Editor, SavedAndOpenedPresetIsTheSame) {
    const std::filesystem::path file = kOut / "editor_saved.json";
    std::filesystem::remove(file);
    TestEditor editor;
    Settings& s = editor.state().settings;
    s.bias.constant = 3.25;
    s.lights[0].azimuth = 12.5;
    s.view.overlay = 2;
    const Settings saved = s;
    EditorRequests requests = editor.frame();
    requests.save_preset = file.string();
    editor.model().fulfil(requests);
    ASSERT_TRUE(std::filesystem::exists(file));
    EXPECT_EQ(load_preset(file.string()).scene, "boxes");
    s = Settings{};
    requests.save_preset.reset();
    requests.load_preset = file.string();
    editor.model().fulfil(requests);
    EXPECT_EQ(s, saved);
    expect_calm(editor);
}

TEST(Editor, UnreadableFileIsALineInTheLog) {
    const std::filesystem::path broken = kOut / "broken_preset.json";
    std::ofstream(broken) << "{\"format\": 3";
    TestEditor editor;
    EditorState& state = editor.state();
    const Settings before = state.settings;
    for (const char* name : {"/nowhere/scene.gltf", "no-such-scene"}) {
        editor.model().open(name);
        editor.model().finish_loading();
        EXPECT_EQ(state.log.lines().back().kind, LogKind::Error);
    }
    editor.model().open(broken);
    EXPECT_EQ(state.log.lines().back().kind, LogKind::Error);
    EXPECT_NE(editor.last_line().find("broken_preset.json"), std::string::npos);
    editor.settle();
    EXPECT_TRUE(state.shows(Page::Log));
    EXPECT_EQ(state.settings, before);
    EXPECT_EQ(state.scene_name, "boxes");
    ASSERT_TRUE(editor.facts().result) << "the editor goes on with the scene it had";

    // Another scene applies its suggestions and keeps chosen settings.
    state.settings.bias.constant = 7;
    const std::string other(builtin_scenes().front().key);
    ASSERT_NE(other, "boxes");
    const std::size_t lines = state.log.lines().size();
    editor.model().open(other);
    editor.settle();
    for (std::size_t i = lines; i < state.log.lines().size(); ++i)
        EXPECT_EQ(state.log.lines()[i].kind, LogKind::Info) << state.log.lines()[i].text;
    Settings expected = base_settings(load_scene(other));
    expected.bias.constant = 7;
    EXPECT_EQ(state.settings, expected);
}

TEST(Editor, CommandLineNamesChangedSettings) {
    const Scene scene = load_scene("boxes");
    Settings s = base_settings(scene);
    EXPECT_EQ(command_line("boxes", scene, s, 640, 480), "shadow-inspector render boxes -o out.png --size 640x480");
    s.bias.constant = 2.5;
    s.objects["It's a node"].cast = false;
    EXPECT_EQ(command_line("boxes", scene, s, 640, 480),
              "shadow-inspector render boxes -o out.png --size 640x480 --set bias.constant=2.5 "
              "--set 'object.It'\\''s a node.cast=false'");
}

TEST(Editor, ProbeMarksItsTexelInTheMap) {
    TestEditor editor;
    editor.drag({{270, 330}});
    const EditorFrame facts = editor.facts();
    ASSERT_TRUE(facts.probe);
    EXPECT_TRUE(facts.probe->hit);
    ASSERT_EQ(facts.probe->lights.size(), 1u);
    EXPECT_TRUE(editor.state().shows(Page::Pixel));
}

}  // namespace
}  // namespace si
