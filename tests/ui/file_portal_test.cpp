// Tests of the desktop's file dialog, on a private bus.
#if defined(SI_FILE_PORTAL)
#include "app/editor/file_portal.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "tests/support/process.h"
#include "tests/ui/fake_portal.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

using Answer = FilePortal::Answer;

/// Portal that counts calls of wake() and waits for answers as the editor does.
struct WokenPortal {
    std::atomic<int> times = 0;
    FilePortal portal{[this] { ++times; }};

    /// Waits for the `wanted`-th call of wake(). Returns the answer; fails the test if there is none.
    Answer wait(int wanted) {
        within_minutes([&] { return times >= wanted; });
        const std::optional<Answer> answer = portal.take_answer();
        EXPECT_TRUE(answer) << "no answer after " << times << " calls";
        return answer.value_or(Answer{});
    }
};

std::vector<std::string> names(const FakePortal::Options& options) {
    using Filter = sdbus::Struct<std::string, std::vector<sdbus::Struct<std::uint32_t, std::string>>>;
    std::vector<std::string> out;
    for (const Filter& filter : options.at("filters").get<std::vector<Filter>>()) {
        std::string line = filter.get<0>() + ":";
        for (const auto& pattern : filter.get<1>()) {
            EXPECT_EQ(pattern.get<0>(), 0u) << "a glob";
            line += " " + pattern.get<1>();
        }
        out.push_back(line);
    }
    return out;
}

TEST(FilePortal, FileIsChosen) {
    const PrivateBus bus(fresh_test_folder());
    FakePortal desktop;
    WokenPortal woken;
    woken.portal.open_dialog({FileDialog::Job::Open, FileDialog::Kind::Presets, "/some where", ""}, "x11:2a");
    ASSERT_TRUE(desktop.wait_for_questions(1));
    EXPECT_FALSE(woken.portal.take_answer()) << "a person takes time";
    const FakePortal::Question question = desktop.questions()[0];
    EXPECT_EQ(question.method, "OpenFile");
    EXPECT_EQ(question.parent_window, "x11:2a");
    EXPECT_EQ(question.title, "Open a model, map, bundle, capture or preset");
    const auto folder = question.options.at("current_folder").get<std::vector<std::uint8_t>>();
    EXPECT_EQ(std::string(folder.begin(), folder.end()), std::string("/some where") + '\0');
    const std::vector<std::string> filters = names(question.options);
    ASSERT_EQ(filters.size(), 3u);
    const std::string models =
        "*.[gG][lL][tT][fF] *.[gG][lL][bB] *.[vV][rR][mM] *.[bB][uU][nN][dD][lL][eE] *.[zZ][iI][pP] ";
    const std::string frames =
        " *.[xX][gG][lL] *.[rR][dD][cC] *.[pP][fF][mM] *.[eE][xX][rR] *.[pP][nN][gG] *.[rR][aA][wW]";
    const std::string presets = " *.[jJ][sS][oO][nN]";
    EXPECT_TRUE(filters[0].starts_with("Scenes and presets: " + models)) << filters[0];
    EXPECT_TRUE(filters[0].ends_with(frames + presets)) << filters[0];
    EXPECT_TRUE(filters[1].starts_with("Scenes: " + models)) << filters[1];
    EXPECT_NE(filters[1].find(" *.3[dD][sS] "), std::string::npos) << filters[1];
    EXPECT_TRUE(filters[1].ends_with(frames)) << filters[1];
    EXPECT_EQ(filters[2], "Presets:" + presets);
    using Filter = sdbus::Struct<std::string, std::vector<sdbus::Struct<std::uint32_t, std::string>>>;
    EXPECT_EQ(question.options.at("current_filter").get<Filter>().get<0>(), "Presets");
    desktop.answer(question, 0, {"file:///some%20where/gr%C3%B6%C3%9Fe%2520.json"});
    const Answer answer = woken.wait(1);
    EXPECT_EQ(answer.kind, Answer::Kind::Chosen) << answer.problem;
    EXPECT_EQ(answer.job, FileDialog::Job::Open);
    EXPECT_EQ(answer.file, "/some where/größe%20.json");
    EXPECT_FALSE(woken.portal.take_answer()) << "once";
}

TEST(FilePortal, ClosedDialogChoosesNothingAndSavingProposesAName) {
    const PrivateBus bus(fresh_test_folder());
    FakePortal desktop;
    WokenPortal woken;
    woken.portal.open_dialog({FileDialog::Job::SavePreset, FileDialog::Kind::All, "/a", "mine.json"}, "");
    ASSERT_TRUE(desktop.wait_for_questions(1));
    const FakePortal::Question question = desktop.questions()[0];
    EXPECT_EQ(question.method, "SaveFile");
    EXPECT_EQ(question.options.at("current_name").get<std::string>(), "mine.json");
    desktop.answer(question, 1, {});
    EXPECT_EQ(woken.wait(1).kind, Answer::Kind::Dismissed);
    // An answer that names no file of this machine chooses nothing either.
    woken.portal.open_dialog({FileDialog::Job::SavePreset, FileDialog::Kind::All, "/a", "mine.json"}, "");
    ASSERT_TRUE(desktop.wait_for_questions(2));
    desktop.answer(desktop.questions()[1], 0, {"https://example.org/a.json"});
    const Answer answer = woken.wait(2);
    EXPECT_EQ(answer.kind, Answer::Kind::Dismissed);
    EXPECT_EQ(answer.job, FileDialog::Job::SavePreset);
}

TEST(FilePortal, ReportsAMissingDesktopOrBus) {
    WokenPortal woken;
    {
        const PrivateBus bus(fresh_test_folder());
        woken.portal.open_dialog({}, "");
        const Answer answer = woken.wait(1);
        EXPECT_EQ(answer.kind, Answer::Kind::NoDialog);
        EXPECT_FALSE(answer.problem.empty());
    }
    unsetenv("XDG_RUNTIME_DIR");
    woken.portal.open_dialog({}, "");
    const Answer answer = woken.wait(2);
    EXPECT_EQ(answer.kind, Answer::Kind::NoDialog);
    EXPECT_FALSE(answer.problem.empty());
}

TEST(FilePortal, SecondRequestOrDestructionClosesTheDialog) {
    const PrivateBus bus(fresh_test_folder());
    FakePortal desktop;
    {
        WokenPortal woken;
        woken.portal.open_dialog({.folder = "/first"}, "");
        ASSERT_TRUE(desktop.wait_for_questions(1));
        woken.portal.open_dialog({.folder = "/second"}, "");
        ASSERT_TRUE(desktop.wait_for_questions(2));
        EXPECT_TRUE(desktop.wait_for_closed(1));
        desktop.answer(desktop.questions()[0], 0, {"file:///first/a.glb"});
        desktop.answer(desktop.questions()[1], 0, {"file:///second/a.glb"});
        EXPECT_EQ(woken.wait(1).file, "/second/a.glb");
        EXPECT_EQ(woken.times, 1);
        woken.portal.open_dialog({.folder = "/third"}, "");
        ASSERT_TRUE(desktop.wait_for_questions(3));
    }
    EXPECT_TRUE(desktop.wait_for_closed(2)) << "with the editor";
}

TEST(FilePortal, LostBusConnectionCountsAsNoDialog) {
    WokenPortal woken;
    {
        const PrivateBus bus(fresh_test_folder());
        {
            FakePortal desktop;
            woken.portal.open_dialog({}, "");
            ASSERT_TRUE(desktop.wait_for_questions(1));
        }
        EXPECT_FALSE(woken.portal.take_answer());
    }
    EXPECT_EQ(woken.wait(1).kind, Answer::Kind::NoDialog);
}

TEST(FilePortal, AcceptsOnlyFilesOfThisMachine) {
    EXPECT_EQ(path_of_file_uri("file:///a/b%20c"), "/a/b c");
    EXPECT_EQ(path_of_file_uri("file://localhost/a"), "/a");
    for (const char* none : {"", "/a", "http://a/b", "file://elsewhere/a", "file://", "file:///a%00b"})
        EXPECT_EQ(path_of_file_uri(none), "") << none;
}

TEST(DesktopDialogs, AreUsedIfAvailableAndEnabled) {
    UiHarness ui(1280, 720);
    const auto request_file = [&] {
        open_file_dialog(ui.state.files.dialog, FileDialog::Job::SavePreset, "/tmp/mine.json", "Look.");
        const EditorRequests first = ui.frame();
        ui.frames(2);
        const bool own = ui.drawn().shows("Save the preset as");
        ui.state.files.dialog.asked = false;
        return std::pair(first.open_desktop_dialog, own);
    };
    ui.desktop_dialogs = true;
    const auto [request, own] = request_file();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->job, FileDialog::Job::SavePreset);
    EXPECT_EQ(request->folder, "/tmp");
    EXPECT_EQ(request->name, "mine.json");
    EXPECT_FALSE(own);
    EXPECT_FALSE(ui.frame().open_desktop_dialog) << "once";
    ui.state.layout.desktop_dialogs = false;
    const auto [unwanted, own_then] = request_file();
    EXPECT_FALSE(unwanted);
    EXPECT_TRUE(own_then);
}

class WindowOfADesktop : public Window {};

TEST_F(WindowOfADesktop, UsesTheDesktopDialogAndFallsBackToTheEditorsOwn) {
    const PrivateBus bus(folder_);
    const fs::path file = folder_ / "from the desktop.glb";
    ASSERT_EQ(run_program({"export", "boxes", "-o", file.string()}).code, 0);
    fs::copy_file(file, folder_ / "typed.glb");
    {
        FakePortal desktop;
        ASSERT_NO_FATAL_FAILURE(start());
        keys("ctrl+o");
        ASSERT_TRUE(desktop.wait_for_questions(1));
        EXPECT_TRUE(desktop.questions()[0].parent_window.starts_with("x11:")) << desktop.questions()[0].parent_window;
        screen("window_desktop_dialog");
        desktop.answer(desktop.questions()[0], 0, {"file://" + (folder_ / "from%20the%20desktop.glb").string()});
        EXPECT_TRUE(shows("from the desktop.glb")) << log();
        wait_until_idle();
        keys("ctrl+shift+s");
        ASSERT_TRUE(desktop.wait_for_questions(2));
        desktop.answer(desktop.questions()[1], 0, {"file://" + (folder_ / "chosen").string()});
        EXPECT_TRUE(wait_until([&] { return fs::exists(folder_ / "chosen.json"); })) << log();
        wait_until_idle();
    }
    keys("ctrl+o");
    wait_until_idle();
    screen("window_desktop_gone");
    type((folder_ / "typed.glb").string());
    keys("Return");
    EXPECT_TRUE(shows("typed.glb")) << log();
    quit();
}

}  // namespace
}  // namespace si::test

#else
#include <gtest/gtest.h>

TEST(FilePortal, NeedsABuildWithFilePortal) {
    GTEST_SKIP() << "7 tests: this build has SI_FILE_PORTAL=OFF";
}
#endif
