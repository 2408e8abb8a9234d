// Tests of screenshots of the scene, the map and the window.
#include "app/editor/screenshot.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <stb_image.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"

namespace si {
namespace {

namespace fs = std::filesystem;

ByteImage read_back(const fs::path& file) {
    ByteImage image;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> data(
        stbi_load(file.c_str(), &image.width, &image.height, &channels, 4), stbi_image_free);
    if (data) image.data.assign(data.get(), data.get() + std::ptrdiff_t(image.width) * image.height * 4);
    return image;
}

SI_TEST_IS(Later, Screenshot, SavesItsPartOfTheWindowUnderAFreeName);
TEST(Screenshot, SavesItsPartOfTheWindowUnderAFreeName) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "boxes-scene-1.png") << "mine";
    EditorOptions o = test::editor_options();
    o.preset = folder / "preset.json";
    test::TestEditor editor(o);
    EditorState& state = editor.state();
    const auto press = [&](bool ctrl, bool shift) {
        editor.mouse.ctrl = ctrl;
        editor.mouse.shift = shift;
        editor.key(301);
        editor.mouse.ctrl = editor.mouse.shift = false;
    };
    press(false, false);
    EXPECT_EQ(file_bytes(folder / "boxes-scene-1.png"), "mine") << "it is never overwritten";
    const ByteImage scene = read_back(folder / "boxes-scene-2.png");
    ASSERT_TRUE(state.viewport.view);
    EXPECT_EQ(scene.width, int(state.viewport.view->size.x));
    EXPECT_EQ(scene.height, int(state.viewport.view->size.y));
    EXPECT_NE(state.log.lines().back().text.find((folder / "boxes-scene-2.png").string()), std::string::npos);
    const ByteImage window = editor.picture();
    const glm::ivec2 at(state.shots.scene_rect.lo);
    const auto pixel = [](const ByteImage& i, int x, int y) {
        const auto* p = &i.data[(std::size_t(y) * std::size_t(i.width) + std::size_t(x)) * 4];
        return std::array<int, 3>{p[0], p[1], p[2]};
    };
    for (int y = 5; y < scene.height; y += 37)
        for (int x = 5; x < scene.width; x += 41)
            ASSERT_EQ(pixel(scene, x, y), pixel(window, at.x + x, at.y + y)) << x << ", " << y;
    press(false, true);
    const ByteImage map = read_back(folder / "boxes-map-1.png");
    EXPECT_EQ(map.width, int(state.shots.map_rect.size.x));
    press(true, false);
    EXPECT_EQ(read_back(folder / "boxes-window-1.png").width, 1280);
    state.layout.map_place = MapSpot::Hidden;
    press(false, true);
    EXPECT_FALSE(fs::exists(folder / "boxes-map-2.png"));
    EXPECT_NE(state.log.lines().back().text.find("hidden"), std::string::npos);
    for (const auto& entry : fs::directory_iterator(folder)) EXPECT_GT(fs::file_size(entry), 0u) << entry.path();
}

SI_TEST_IS(Later, Screenshot, SectionDrawingIsSavedAsPngAndSvg);
TEST(Screenshot, SectionDrawingIsSavedAsPngAndSvg) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "boxes-drawing-1.svg") << "mine";
    EditorOptions o = test::editor_options("boxes", {}, {1600, 900});
    o.preset = folder / "preset.json";
    test::TestEditor editor(o);
    EditorState& state = editor.state();
    state.shots.next = Shot::Drawing;
    editor.frames(3);
    EXPECT_NE(editor.last_line().find("click a pixel"), std::string::npos);
    state.probe_pixel = glm::ivec2(state.viewport.wanted_size.x / 2, state.viewport.wanted_size.y * 3 / 4);
    state.window.open_page = Page::Pixel;
    editor.settle();
    state.shots.next = Shot::Drawing;
    editor.frames(3);
    const ByteImage drawing = read_back(folder / "boxes-drawing-2.png");
    // The picture is as large as the SVG, with verdict and legend, whatever the size of the panel.
    EXPECT_GT(drawing.width, 600) << state.log.lines().back().text;
    EXPECT_GT(drawing.height, int(1.5f * state.shots.drawing_rect.size.y));
    std::set<std::uint32_t> colours;
    for (std::size_t i = 0; i + 3 < drawing.data.size(); i += 4)
        colours.insert(drawing.data[i] | drawing.data[i + 1] << 8 | drawing.data[i + 2] << 16);
    EXPECT_GT(colours.size(), 50u) << "letters, lines and fills";
    const std::string svg = file_bytes(folder / "boxes-drawing-2.svg");
    EXPECT_EQ(svg.substr(0, 4), "<svg");
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    EXPECT_EQ(file_bytes(folder / "boxes-drawing-1.svg"), "mine") << "it is never overwritten";
    EXPECT_FALSE(fs::exists(folder / "boxes-drawing-1.png"));
}

TEST(Screenshot, ReportsWriteErrors) {
    EXPECT_THROW(save_screenshot({1, 1, {0, 0, 0, 0}}, Shot::Map, "a/b.glb", "/no such folder"), std::exception);
}

}  // namespace
}  // namespace si
