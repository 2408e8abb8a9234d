// Tests of the editor's window with files: menu, dialog and drop, saved presets, and state kept between runs.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "renderer/scenes/builtin.h"
#include "tests/support/process.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "tests/ui/window_fixture.h"
#include "tests/ui/xdnd.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

// At 1280x720. The dialog is 44 by 32 ems in the middle: its first entry, its field for the name.
constexpr int kFileX = 26, kTopY = 19, kEntryX = 420, kEntryY = 183, kEntryStep = 21;
constexpr int kSearchX = 1040, kSearchY = 376, kSliderX = 1170, kSliderY = 433;

class WindowFiles : public Window {
protected:
    /// Writes a small scene file that is not part of the program.
    fs::path model(const std::string& name) const {
        const fs::path file = folder_ / name;
        EXPECT_EQ(run_program({"export", "boxes", "-o", file.string()}).code, 0);
        return file;
    }
    /// Chooses an entry of the menu File, counted from 0.
    void choose(int entry) const {
        click(kFileX, kTopY);
        click(kFileX + 30, 47 + entry * 20);
        wait_until_idle();
    }
    void change_bias() const {
        click(kSearchX, kSearchY);
        type("bias.constant");
        drag(kSliderX, kSliderY, 60, 0);
    }
    /// Returns the settings of the session file, as after a crash; null if none.
    nlohmann::json kept() const {
        std::error_code none_yet;
        for (const auto& entry : fs::directory_iterator(state_folder() / "sessions", none_yet))
            if (entry.path().extension() == ".json")
                if (const auto json = json_of(entry.path()); json.is_object())
                    return json.value("settings", nlohmann::json());
        return {};
    }
    std::vector<std::string> below(const fs::path& folder) const {
        std::vector<std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(folder)) files.push_back(entry.path().string());
        return files;
    }
};

TEST_F(WindowFiles, ModelIsOpenedByItsTypedPath) {
    const fs::path file = model("typed model.glb");
    ASSERT_NO_FATAL_FAILURE(start());
    choose(0);  // Open
    screen("window_open_dialog");
    type(file.string());
    keys("Return");
    EXPECT_TRUE(shows("typed model.glb")) << log();
    screen("window_opened");
    keys("ctrl+z");
    EXPECT_TRUE(shows("boxes")) << "undo brings the scene before back";
    quit();
}

TEST_F(WindowFiles, ModelIsOpenedByADoubleClickInTheDialog) {
    const fs::path only = folder_ / "models";
    for (const fs::path& listed : {only, folder_ / "cache", folder_ / "state"}) fs::create_directories(listed);
    fs::rename(model("clicked.gltf"), only / "clicked.gltf");
    ASSERT_NO_FATAL_FAILURE(start());
    keys("ctrl+o");
    wait_until_idle();
    // Returns whether the dialog lists a third entry: the folders are cache, home, models, state; models holds one
    // file.
    const auto third = [&] {
        const ByteImage seen = screen("window_open_folder");
        for (int y = kEntryY + 2 * kEntryStep - 6; y < kEntryY + 2 * kEntryStep + 6 && seen.width == kWidth; ++y)
            for (int x = 320; x < 370; ++x)
                if (seen.data[4 * (std::size_t(y) * kWidth + std::size_t(x))] > 128) return true;
        return false;
    };
    EXPECT_TRUE(wait_until(third));
    double_click(kEntryX, kEntryY + 2 * kEntryStep, [&] { return !third(); });
    double_click(kEntryX, kEntryY, [&] { return titled("clicked.gltf"); });
    EXPECT_TRUE(shows("clicked.gltf")) << log();
    quit();
}

TEST_F(WindowFiles, SavedPresetLoadsIdentically) {
    ASSERT_NO_FATAL_FAILURE(start());
    const nlohmann::json untouched = saved();
    change_bias();
    const nlohmann::json changed = saved();
    ASSERT_TRUE(changed.contains("bias.constant")) << changed;
    keys("ctrl+shift+s");
    wait_until_idle();
    keys("ctrl+a");
    type("mine");
    keys("Return");
    ASSERT_TRUE(wait_until([&] { return fs::exists(folder_ / "mine.json"); })) << log();
    const nlohmann::json mine = json_of(folder_ / "mine.json");
    EXPECT_EQ(mine.value("settings", nlohmann::json()), changed);
    EXPECT_EQ(mine.value("scene", ""), "boxes");
    keys("ctrl+z");
    ASSERT_EQ(saved("mine.json"), untouched);

    fs::copy_file(folder_ / "preset.json", folder_ / "other.json");  // with the changed bias
    keys("ctrl+o");
    wait_until_idle();
    type((folder_ / "other.json").string());
    keys("Return");
    wait_until_idle();
    EXPECT_EQ(saved("other.json"), changed);
    screen("window_preset_loaded");
    quit();
}

TEST_F(WindowFiles, DroppedModelAndPresetAreOpened) {
    const fs::path file = model("dropped måne 1.glb");
    const fs::path preset = folder_ / "dropped.JSON";
    ASSERT_EQ(run_program({"preset", "save", "plane", "--set", "bias.constant=7", "-o", preset.string()}).code, 0);
    ASSERT_NO_FATAL_FAILURE(start());
    const unsigned long window = std::strtoul(ask("search --name 'Shadow Inspector'").c_str(), nullptr, 10);
    ASSERT_NE(window, 0u);
    EXPECT_TRUE(drop_file(window, file, 300, 300));
    EXPECT_TRUE(shows("dropped måne 1.glb")) << log();
    screen("window_dropped");
    EXPECT_TRUE(drop_file(window, preset, 300, 300));
    EXPECT_TRUE(shows("plane")) << log();
    EXPECT_EQ(saved("dropped.JSON").value("bias.constant", 0.0), 7);
    // Other files are reported, and nothing is lost.
    ASSERT_TRUE(program_->running()) << program_->code();
    EXPECT_TRUE(drop_file(window, folder_ / "program.log", 300, 300));
    wait_until_idle();
    EXPECT_EQ(saved("dropped.JSON").value("bias.constant", 0.0), 7);
    screen("window_dropped_nonsense");
    quit();
}

TEST_F(WindowFiles, DroppedCaptureIsOpenedThroughItsDialogs) {
    const fs::path made = folder_ / "made.bundle", capture = folder_ / "frame.rdc", helper = folder_ / "python";
    ASSERT_EQ(run_program({"export", "plane", "--size", "64x64", "--bundle", made.string()}).code, 0);
    std::ofstream(capture) << "RDOC and nothing else";
    // The helper waits for a file, so that the progress is seen.
    std::ofstream(helper) << "#!/bin/sh\n"
                             "for w in \"$@\"; do case \"$w\" in --list) list=1;; --output=*) out=\"${w#--output=}\";; "
                             "esac; done\n"
                             "echo '{\"progress\": 0.5, \"label\": \"looking at passes\"}'\n"
                             "if [ \"$list\" ]; then while [ ! -e go ]; do sleep 0.1; done\n"
                             "echo '{\"candidate\": {\"number\": 0, \"texture\": 7, \"width\": 64, \"height\": 64, "
                             "\"format\": \"D16\", \"draws\": 3}}'; exit 0; fi\n"
                             "cp -r made.bundle/. \"$out\"; echo '{\"done\": true}'\n";
    fs::permissions(helper, fs::perms::owner_all);
    setenv("SI_CAPTURE_PYTHON", helper.c_str(), 1);
    ASSERT_NO_FATAL_FAILURE(start());
    unsetenv("SI_CAPTURE_PYTHON");
    const unsigned long window = std::strtoul(ask("search --name 'Shadow Inspector'").c_str(), nullptr, 10);
    EXPECT_TRUE(drop_file(window, capture, 300, 300));
    wait_until_idle();
    screen("window_capture_warning");
    keys("Return");
    std::this_thread::sleep_for(std::chrono::seconds(2));
    screen("window_capture_progress");
    // The window answers while the helper runs, and never sleeps for long.
    EXPECT_FALSE(saved().is_null());
    EXPECT_FALSE(fs::exists(folder_ / "frame.bundle"));
    std::ofstream(folder_ / "go") << "on";
    ASSERT_TRUE(wait_until([&] {
        std::this_thread::sleep_for(std::chrono::seconds(2));
        if (titled("frame.bundle")) return true;
        screen("window_capture_choice");
        keys("Return");
        return false;
    })) << log();
    screen("window_capture_opened");
    const auto kept_files = json_of(state_folder() / "workspace.json");
    ASSERT_TRUE(kept_files.is_object());
    EXPECT_EQ(kept_files["recent_scenes"][0], (folder_ / "frame.bundle").string());
    EXPECT_EQ(kept_files.value("capture_warned", false), true);
    quit();
}

TEST_F(WindowFiles, ScreenshotIsAFileAndInTheClipboard) {
    ASSERT_NO_FATAL_FAILURE(start());
    keys("F12");
    const fs::path file = folder_ / "boxes-scene-1.png", pasted = folder_ / "pasted.png";
    ASSERT_TRUE(wait_until([&] {
        return std::system(
                   fmt::format("timeout 10 xclip -selection clipboard -target image/png -out > '{}' 2>/dev/null "
                               "&& cmp -s '{}' '{}'",
                               pasted.string(), pasted.string(), file.string())
                       .c_str()) == 0;
    })) << log();
    EXPECT_GT(fs::file_size(pasted), 1000u);
    quit();
}

TEST_F(WindowFiles, DragWithALostSourceIsHarmless) {
    ASSERT_NO_FATAL_FAILURE(start());
    const unsigned long window = std::strtoul(ask("search --name 'Shadow Inspector'").c_str(), nullptr, 10);
    for (int i = 0; i < 5; ++i) begin_abandoned_drag(window, 300, 300);
    EXPECT_TRUE(wait_until([&] { return log().find("BadWindow") != std::string::npos; })) << log();
    EXPECT_TRUE(program_->running()) << log();
    EXPECT_FALSE(saved().contains("bias.constant"));
    quit();
}

TEST_F(WindowFiles, ClosedEditorOffersUnsavedSettingsAgain) {
    ASSERT_NO_FATAL_FAILURE(start());
    change_bias();
    quit();
    const nlohmann::json changed = kept();
    ASSERT_TRUE(changed.contains("bias.constant")) << "quit without a word, and lost: " << changed;

    ASSERT_NO_FATAL_FAILURE(start());
    click(808, 54);  // Restore
    wait_until_idle();
    EXPECT_EQ(saved(), changed);
    quit();
    EXPECT_TRUE(kept().is_null()) << "saved: nothing to offer";

    ASSERT_NO_FATAL_FAILURE(start());
    change_bias();
    program_->send(SIGTERM);
    EXPECT_TRUE(wait_until([&] { return !program_->running(); }));
    EXPECT_EQ(program_->code(), 0) << log();
    EXPECT_FALSE(kept().is_null()) << "ended by a signal, and lost";
}

TEST_F(WindowFiles, KilledEditorOffersItsSettingsAgain) {
    ASSERT_NO_FATAL_FAILURE(start());
    const nlohmann::json untouched = saved();
    change_bias();
    const nlohmann::json changed = saved();
    ASSERT_TRUE(changed.contains("bias.constant")) << changed;
    ASSERT_TRUE(wait_until([&] { return kept() == changed; })) << kept();
    program_->kill_at_once();

    ASSERT_NO_FATAL_FAILURE(start());
    screen("window_restore");
    EXPECT_EQ(saved(), untouched) << "restored without being asked";
    click(808, 54);  // Restore
    wait_until_idle();
    EXPECT_EQ(saved(), changed);
    keys("ctrl+z");
    EXPECT_EQ(saved(), untouched);
    quit();
    EXPECT_TRUE(kept().is_null()) << "a clean end leaves nothing to restore";
}

/// Returns the position of the splitter between scene and map in a window of that size.
glm::ivec2 splitter(int width, int height) {
    EditorOptions o = editor_options("boxes", {}, {width, height});
    o.scale = 1;
    const TestEditor editor(o);
    const ImGuiWindow *scene = UiHarness::window("editor/scene_"), *map = UiHarness::window("editor/map_");
    if (!scene || !map) return {};
    return {int(0.5f * (scene->Pos.x + scene->Size.x + map->Pos.x)), int(map->Pos.y + 0.5f * map->Size.y)};
}

TEST_F(WindowFiles, OnlyLayoutAndSizePersist) {
    ASSERT_NO_FATAL_FAILURE(start({}));
    ASSERT_TRUE(xdotool("search --name 'Shadow Inspector' windowsize 1100 640"));
    wait_until_idle();
    const auto share = [&] {
        const auto json = json_of(state_folder() / "workspace.json");
        return json.is_object() ? json.value("/layout/settings_width"_json_pointer, -1.0) : -1.0;
    };
    const glm::ivec2 at = splitter(1100, 640);
    ASSERT_GT(at.x, 0);
    drag(at.x, at.y, -90, 0);
    ASSERT_TRUE(wait_until([&] { return share() > 0; })) << "not kept while the editor runs";
    quit();
    const double kept_share = share();
    EXPECT_GT(kept_share, double(EditorLayout{}.settings_width) + 3);

    ASSERT_NO_FATAL_FAILURE(start({}));
    EXPECT_NE(ask("search --name 'Shadow Inspector' getwindowgeometry").find("1100x640"), std::string::npos);
    // The splitter keeps its place: a drag from there moves it again.
    drag(at.x - 90, at.y, 45, 0);
    screen("window_kept_layout");
    quit();
    EXPECT_LT(share(), kept_share - 1);
    EXPECT_GT(share(), double(EditorLayout{}.settings_width));
    EXPECT_EQ(below(home()), std::vector<std::string>{});
    std::vector<std::string> kept_files = below(state_folder());
    std::erase(kept_files, (state_folder() / "workspace.json").string());
    std::erase(kept_files, (state_folder() / "workspace.lock").string());
    std::erase(kept_files, (state_folder() / "sessions").string());
    EXPECT_EQ(kept_files, std::vector<std::string>{}) << "left behind";
}

TEST_F(WindowFiles, NothingIsKeptWithoutState) {
    ASSERT_NO_FATAL_FAILURE(start({"--no-state", "--size", "1280x720"}));
    change_bias();
    const glm::ivec2 at = splitter(1280, 720);
    drag(at.x, at.y, -90, 0);
    std::this_thread::sleep_for(std::chrono::seconds(3));  // longer than any delay before saving
    EXPECT_FALSE(fs::exists(folder_ / "state"));
    quit();
    EXPECT_FALSE(fs::exists(folder_ / "state"));
    EXPECT_EQ(below(home()), std::vector<std::string>{});
}

}  // namespace
}  // namespace si::test
