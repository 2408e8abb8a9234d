// Tests of the welcome window: shown once, and only to a person who requested nothing.
#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>

#include "app/base/output.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "ui/state/light_list.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

class Welcome : public testing::Test {
protected:
    Welcome() {
        ui.presets = {{.key = "acne"}, {.key = "bias"}};
        ui.state.window.show_welcome = true;
        ui.frames(4);
    }
    EditorRequests click(const char* label) {
        const auto at = ui.find("Welcome", "", label);
        EXPECT_TRUE(at) << label;
        if (!at) return {};
        ui.move(*at);
        ui.frames(2);
        return ui.click_here();
    }
    bool open() const { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup); }
    UiHarness ui{1280, 720};
};

TEST_F(Welcome, EscClosesIt) {
    EXPECT_TRUE(open());
    EXPECT_TRUE(ui.frame().welcomed);
    ui.key(ImGui::GetKeyIndex(ImGuiKey_Escape));
    ui.frames(2);
    EXPECT_FALSE(ui.state.window.show_welcome || open());
}

TEST_F(Welcome, FileDialogOpensAModel) {
    click("Open a model…");
    ui.frames(2);
    EXPECT_TRUE(open()) << "the file dialog";
    EXPECT_FALSE(ui.state.window.show_welcome);
}

TEST_F(Welcome, TourBeginsWithTheFirstPreset) {
    EXPECT_EQ(click("Guided tour").load_preset, "acne");
    EXPECT_FALSE(ui.state.window.show_welcome);
}

TEST_F(Welcome, StageReplacesAnotherScene) {
    ui.state.scene_name = "boxes";
    EXPECT_EQ(click("Look at the stage").load_scene, "stage");
}

SI_TEST_IS(Later, WelcomeOnce, IsRememberedAndNeverShownHeadless);
TEST(WelcomeOnce, IsRememberedAndNeverShownHeadless) {
    EditorOptions options = editor_options("boxes", {}, {640, 400});
    options.welcome = true;
    options.state_folder = fresh_test_folder();
    const auto shown = [](const EditorOptions& o) {
        HeadlessEditor editor(o);
        const bool welcome = editor.model().state.window.show_welcome;
        for (int i = 0; i < 3; ++i) editor.frame();
        if (welcome) write_png(fs::path(SI_TEST_OUTPUT_DIR) / "welcome.png", editor.picture());
        return welcome;
    };
    EditorOptions other = options;
    other.headless = true;
    EXPECT_FALSE(shown(other));
    other = options;
    other.state_folder.clear();
    EXPECT_FALSE(shown(other)) << "--no-state";
    other = options;
    other.welcome = false;
    EXPECT_FALSE(shown(other)) << "something was asked for";
    EXPECT_TRUE(shown(options));
    EXPECT_FALSE(shown(options));
}

SI_TEST_IS(Later, LightTheme, IsRememberedAndAppliedToTheWindow);
TEST(LightTheme, IsRememberedAndAppliedToTheWindow) {
    EditorOptions options = editor_options();
    options.state_folder = fresh_test_folder();
    double mean[2] = {};
    for (double& m : mean) {
        HeadlessEditor editor(options);
        editor.model().state.settings_panel.search = "intensity";  // with the lights at its head
        editor.settle();
        for (int i = 0; i < 2; ++i) add_light(editor.model().state.settings);
        editor.settle();
        const ByteImage picture = editor.picture();
        write_png(fs::path(SI_TEST_OUTPUT_DIR) / (&m == mean ? "theme_dark.png" : "theme_light.png"), picture);
        // The lower right corner: settings.
        int pixels = 0;
        for (int y = 600; y < 700; ++y)
            for (int x = 1000; x < 1270; ++x, ++pixels) m += picture.data[(std::size_t(y) * 1280 + std::size_t(x)) * 4];
        m /= 255.0 * pixels;
        editor.model().state.layout.light_theme = true;
        editor.model().end();
    }
    EXPECT_LT(mean[0], 0.25);
    EXPECT_GT(mean[1], 0.75);
}

}  // namespace
}  // namespace si::test
