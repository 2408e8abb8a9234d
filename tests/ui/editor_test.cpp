// Tests of the whole editor with the real renderer, drawn through EGL: the shown pictures are the renderer's.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "app/base/output.h"
#include "app/editor/headless_editor.h"
#include "app/session/command_line.h"
#include "app/session/presets.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

const std::filesystem::path kOut = SI_TEST_OUTPUT_DIR;

EditorOptions options(int width, int height, const std::vector<std::string>& sets = {}) {
    EditorOptions o;
    o.session = {.scene = "boxes", .preset = {}, .sets = sets};
    o.width = width;
    o.height = height;
    return o;
}

/// Expects no line worse than information in the log.
void expect_calm(const HeadlessEditor& editor) {
    for (const LogLine& line : const_cast<HeadlessEditor&>(editor).model().state.log.lines())
        EXPECT_EQ(line.kind, LogKind::Info) << line.text;
}

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
    HeadlessEditor editor(options(width, height, {"view.overlay=depth-difference"}));
    editor.model().state.probe_pixel = glm::ivec2(200, 200);
    editor.model().state.window.open_tab = BottomTab::Probe;
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
    HeadlessEditor editor(options(1280, 720, {"view.frustum=false", "view.axes=false"}));
    editor.settle();
    const ByteImage whole = editor.picture();
    const FrameResult& result = *editor.model().facts().result;
    Renderer renderer;
    FrameRequest request;
    request.width = result.colour.width;
    request.height = result.colour.height;
    const Scene scene = load_scene("boxes");
    const ByteImage alone = renderer.read_colour(renderer.render(scene, editor.model().state.settings, request).colour);
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

TEST(Editor, RedrawsTheSceneOnlyAfterAChange) {
    HeadlessEditor editor(options(1280, 720));
    editor.settle();
    const EditorRequests still = editor.frame();
    EXPECT_FALSE(editor.model().fulfil(still));
    editor.model().state.settings.bias.constant += 1;
    EXPECT_TRUE(editor.model().fulfil(still));
    EXPECT_FALSE(editor.model().fulfil(still));
}

TEST(Editor, DrawsEveryOverlayAndMapView) {
    HeadlessEditor editor(options(1280, 720));
    editor.mouse.at = glm::vec2(200, 250);  // numbers are read at the mouse position
    editor.settle();
    const std::size_t overlays = find_setting("view.overlay")->param->choices().size();
    for (std::size_t overlay = 0; overlay < overlays; ++overlay) {
        for (int map = 0; map < (overlay == 0 ? 3 : 1); ++map) {
            editor.model().state.settings.view.overlay = int(overlay);
            editor.model().state.settings.view.map = MapView((int(overlay) + map) % 3);
            for (int i = 0; i < 3; ++i) editor.frame();
            if (editor.model().facts().result->panes.front().lacks_reference) editor.settle();
            EXPECT_EQ(editor.model().facts().overlay_values != nullptr, overlay > 0) << overlay << ", " << map;
        }
    }
    expect_calm(editor);
}

TEST(Editor, DrawsEveryKindOfLightAndEveryFace) {
    HeadlessEditor editor(options(1280, 720));
    editor.settle();
    for (const LightType type : {LightType::Directional, LightType::Spot, LightType::Point})
        for (int face = 0; face < (type == LightType::Point ? 6 : 1); ++face) {
            Settings& s = editor.model().state.settings;
            s.light_count = 2;
            s.lights[1].type = type;
            s.view.light = 1;
            s.view.face = face;
            for (int i = 0; i < 3; ++i) editor.frame();
            EXPECT_NE(editor.model().facts().result->map_view.texture, 0u);
        }
    expect_calm(editor);
}

TEST(Editor, SavedAndOpenedPresetIsTheSame) {
    const std::filesystem::path file = kOut / "editor_saved.json";
    std::filesystem::remove(file);
    HeadlessEditor editor(options(1280, 720));
    editor.settle();
    Settings& s = editor.model().state.settings;
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
    HeadlessEditor editor(options(1280, 720));
    editor.settle();
    const Settings before = editor.model().state.settings;
    for (const char* name : {"/nowhere/scene.gltf", "no-such-scene"}) {
        editor.model().open(name);
        editor.model().finish_loading();
        EXPECT_EQ(editor.model().state.log.lines().back().kind, LogKind::Error);
    }
    editor.model().open(broken);
    EXPECT_EQ(editor.model().state.log.lines().back().kind, LogKind::Error);
    EXPECT_NE(editor.model().state.log.lines().back().text.find("broken_preset.json"), std::string::npos);
    editor.settle();
    EXPECT_EQ(editor.model().state.tab, BottomTab::Log);
    EXPECT_EQ(editor.model().state.settings, before);
    EXPECT_EQ(editor.model().state.scene_name, "boxes");
    ASSERT_TRUE(editor.model().facts().result) << "the editor goes on with the scene it had";
}

TEST(Editor, AnotherSceneAppliesItsSuggestionsAndKeepsChosenSettings) {
    HeadlessEditor editor(options(1280, 720));
    editor.settle();
    editor.model().state.settings.bias.constant = 7;
    const std::string other(builtin_scenes().front().key);
    ASSERT_NE(other, "boxes");
    editor.model().open(other);
    editor.settle();
    Settings expected = base_settings(load_scene(other));
    expected.bias.constant = 7;
    EXPECT_EQ(editor.model().state.settings, expected);
    expect_calm(editor);
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
    HeadlessEditor editor(options(1280, 720));
    editor.settle();
    editor.mouse.at = glm::vec2(270, 330);
    for (const bool down : {false, true, true, false, false, false, false}) {
        editor.mouse.left = down;
        editor.frame();
    }
    const EditorFrame facts = editor.model().facts();
    ASSERT_TRUE(facts.probe);
    EXPECT_TRUE(facts.probe->hit);
    ASSERT_EQ(facts.probe->lights.size(), 1u);
    EXPECT_EQ(editor.model().state.tab, BottomTab::Probe);
}

}  // namespace
}  // namespace si
