// Tests of frames drawn in a thread: the old picture stays with its numbers until the next is ready, and the next has
// the bytes of a blocking draw.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "app/editor/shader_warmup.h"
#include "renderer/gl/target.h"
#include "renderer/settings/param.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"

namespace si {
namespace {

using Bytes = std::vector<std::uint8_t>;

EditorOptions options_of(std::optional<std::chrono::milliseconds> patience) {
    EditorOptions options = test::editor_options("boxes", {"map.resolution=512"}, {800, 600});
    options.frame_patience = patience;
    return options;
}
/// Makes an editor that never waits for frames.
std::unique_ptr<test::TestEditor> hasty_editor() {
    return std::make_unique<test::TestEditor>(options_of(std::chrono::milliseconds(0)));
}
void select_kernel(HeadlessEditor& editor, const char* kernel) {
    set_setting(editor.model().state.settings, "filter.kernel", kernel);
}
/// Returns the shown picture of the scene.
Bytes shown_picture(HeadlessEditor& editor) {
    const Image image = editor.model().facts().result->panes.front().picture;
    Bytes out(std::size_t(image.width) * std::size_t(image.height) * 4);
    gl::prepare_read_back();
    glGetTextureImage(image.texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(out.size()), out.data());
    return out;
}

SI_TEST_IS(Later, FrameLoader, FirstPictureReportsItsProgress);
TEST(FrameLoader, FirstPictureReportsItsProgress) {
    HeadlessEditor editor(options_of(std::chrono::milliseconds(0)));
    EditorModel& model = editor.model();
    std::set<std::string> passes;
    double furthest = 0;
    while (!model.facts().result) {
        model.finish_loading();
        editor.frame();
        while (model.drawing() && !model.tracing_moved() && passes.size() < 2) {
            if (const auto drawing = model.facts().drawing) {
                furthest = std::max(furthest, drawing->progress);
                if (!drawing->pass.empty()) passes.insert(drawing->pass);
            }
        }
        model.finish_drawing();
    }
    EXPECT_GE(passes.size(), 2u);
    EXPECT_GT(furthest, 0);
    select_kernel(editor, "pcf7");
    editor.frame();
    EXPECT_FALSE(model.facts().drawing) << "there is a picture meanwhile";
    editor.settle();
}

TEST(FrameLoader, OldPictureStaysUntilTheNextIsShown) {
    const auto editor = hasty_editor();
    const Bytes before = shown_picture(*editor);
    select_kernel(*editor, "pcss");
    editor->frame();
    ASSERT_TRUE(editor->model().drawing());
    EXPECT_TRUE(shown_picture(*editor) == before) << "while it is drawn";
    editor->model().finish_tracing();
    EXPECT_TRUE(shown_picture(*editor) == before) << "it is there, and nobody took it";
    editor->frame();
    EXPECT_FALSE(shown_picture(*editor) == before);
    editor->settle();
    EXPECT_FALSE(editor->model().drawing());
}

SI_TEST_IS(Later, FrameLoader, PicturesAndNumbersEqualThoseOfABlockingDraw);
TEST(FrameLoader, PicturesAndNumbersEqualThoseOfABlockingDraw) {
    std::vector<Bytes> pictures[2];
    double visibility[2] = {-1, -2};
    std::size_t taps[2] = {1, 2};
    for (const int hasty : {0, 1}) {
        const auto editor = hasty ? hasty_editor() : std::make_unique<test::TestEditor>(options_of({}));
        for (const char* kernel : {"pcf5", "vsm", "pcf3"}) {
            select_kernel(*editor, kernel);
            editor->settle();
            pictures[hasty].push_back(shown_picture(*editor));
        }
        editor->model().state.probe_pixel = glm::ivec2(150, 140);
        editor->settle();
        const Probe* probe = editor->model().facts().probe;
        ASSERT_TRUE(probe && probe->hit);
        visibility[hasty] = probe->lights.front().visibility;
        taps[hasty] = probe->lights.front().taps.size();
    }
    EXPECT_TRUE(pictures[0] == pictures[1]);
    EXPECT_EQ(visibility[0], visibility[1]);
    EXPECT_EQ(taps[0], taps[1]);
}

TEST(FrameLoader, RequestDuringAFrameIsServedAfterIt) {
    const auto editor = hasty_editor();
    select_kernel(*editor, "pcf5");
    EditorRequests requests = editor->frame();
    ASSERT_TRUE(editor->model().drawing());
    const std::filesystem::path file = std::filesystem::path(SI_TEST_OUTPUT_DIR) / "frame_loader_error.json";
    std::filesystem::remove(file);
    requests.save_error = file.string();
    editor->model().fulfil(requests);
    editor->settle();
    const auto& lines = editor->model().state.log.lines();
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(),
                            [](const LogLine& l) { return l.text.find("Not saved") != std::string::npos; }));
}

TEST(FrameLoader, SceneThatArrivesDuringAFrameIsShownNext) {
    const auto editor = hasty_editor();
    const Bytes before = shown_picture(*editor);
    select_kernel(*editor, "pcf7");
    editor->frame();
    ASSERT_TRUE(editor->model().drawing());
    editor->model().open("plane");
    editor->settle();
    EXPECT_EQ(editor->model().state.scene_name, "plane");
    EXPECT_FALSE(shown_picture(*editor) == before);
}

TEST(FrameLoader, FailedFrameIsALineInTheLog) {
    const auto editor = hasty_editor();
    EditorRequests requests = editor->frame();
    editor->settle();
    requests.scene_width = 1 << 20;
    editor->model().fulfil(requests);
    editor->model().finish_drawing();
    EXPECT_FALSE(std::string(editor->model().facts().problem).empty());
    EXPECT_GT(editor->model().state.log.unseen_errors(), 0);
}

TEST(FrameLoader, EditorIdlesAfterShaderWarmUp) {
    const auto editor = hasty_editor();
    const ShaderWarmup& warmup = *editor->model().warmup();
    warmup.wait();
    const std::size_t done = warmup.done();
    EXPECT_GT(done, 0u);
    const std::uint64_t drawn = editor->model().facts().result->contents.parts.front().drawn;
    for (int i = 0; i < 5; ++i) editor->frame();
    editor->model().finish_drawing();
    EXPECT_EQ(editor->model().facts().result->contents.parts.front().drawn, drawn);
    const EditorModel& model = editor->model();
    EXPECT_FALSE(model.loading_moved() || model.measuring_moved() || model.tracing_moved())
        << "nothing calls for a frame";
    warmup.wait();
    EXPECT_EQ(warmup.done(), done);
}

// The map fills the window, so that no picture of the scene is drawn.
TEST(FrameLoader, MapAloneFollowsItsSettings) {
    const auto editor = hasty_editor();
    EditorState& state = editor->model().state;
    state.window.maximised = Panel::Map;
    editor->settle();
    state.settings.map.resolution = 64;
    editor->settle();
    ASSERT_TRUE(editor->model().facts().result);
    EXPECT_EQ(editor->model().facts().result->map_resolution, 64);
}

}  // namespace
}  // namespace si
