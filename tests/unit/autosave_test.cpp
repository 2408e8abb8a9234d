// Tests of crash recovery: kept sessions, who is offered them, and files of running editors. An object destroyed
// without end() acts as a crash.
#include "app/session/autosave.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>

#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;

Settings with_bias(double constant) {
    Settings s;
    s.bias.constant = constant;
    return s;
}

std::size_t files_in(const fs::path& folder, const char* extension) {
    std::error_code error;
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error))
        count += entry.path().extension() == extension;
    return count;
}

/// Runs an editor that changes settings and crashes.
void crash(const fs::path& folder, double bias, const std::string& scene = "boxes") {
    Autosave editor(folder);
    editor.update(scene, with_bias(0.1), 0);
    editor.update(scene, with_bias(bias), 1);
    EXPECT_TRUE(editor.take_remarks().empty());
}

TEST(Autosave, CrashedSessionIsOfferedUntilRestoredOrDiscarded) {
    const fs::path folder = fresh_test_folder();
    EXPECT_EQ(Autosave(folder).lost(), nullptr);
    crash(folder, 7);
    {
        const Autosave ignored(folder);
        ASSERT_NE(ignored.lost(), nullptr);
        EXPECT_EQ(ignored.lost()->preset.settings.bias.constant, 7);
        EXPECT_EQ(ignored.lost()->preset.scene, "boxes");
        EXPECT_LT(ignored.lost()->age_s, 600);
    }
    Autosave next(folder);
    ASSERT_NE(next.lost(), nullptr) << "not answered is not settled";
    next.forget_lost();
    EXPECT_EQ(next.lost(), nullptr);
    EXPECT_EQ(Autosave(folder).lost(), nullptr);
    EXPECT_EQ(files_in(folder, ".json"), 0u);
    EXPECT_EQ(files_in(folder, ".lock"), 0u);
}

TEST(Autosave, CleanEndLeavesNothing) {
    const fs::path folder = fresh_test_folder();
    Autosave editor(folder);
    editor.update("boxes", with_bias(0.1), 0);
    editor.update("boxes", with_bias(2), 1);
    EXPECT_EQ(files_in(folder, ".json"), 1u);
    editor.end("boxes", with_bias(2), false);
    EXPECT_EQ(files_in(folder, ".json"), 0u);
    editor.update("boxes", with_bias(3), 100);
    EXPECT_EQ(files_in(folder, ".json"), 0u) << "the end is the end";
    EXPECT_EQ(Autosave(folder).lost(), nullptr);
}

TEST(Autosave, UnsavedSettingsAreOfferedAgain) {
    const fs::path folder = fresh_test_folder();
    {
        Autosave editor(folder);
        editor.update("boxes", with_bias(0.1), 0);
        editor.end("boxes", with_bias(2), true);  // changed after the last write
    }
    {
        const Autosave next(folder);
        ASSERT_NE(next.lost(), nullptr);
        EXPECT_EQ(next.lost()->preset.settings.bias.constant, 2);
    }
    const auto left_by = [&](const std::string& scene, const Settings& settings) {
        const fs::path own = folder / "own";
        fs::remove_all(own);
        Autosave editor(own);
        editor.update("boxes", with_bias(0.1), 0);
        editor.end(scene, settings, true);
        return files_in(own, ".json");
    };
    EXPECT_EQ(left_by("boxes", with_bias(0.1)), 0u) << "nothing was changed";
    EXPECT_EQ(left_by("stage", with_bias(0.1)), 1u);
    Settings turned = with_bias(0.1);
    turned.camera.azimuth += 30;
    turned.camera.source = CameraSource::Manual;
    turned.view.overlay = 2;
    EXPECT_EQ(left_by("boxes", turned), 0u) << "where one looks is no work";
}

TEST(Autosave, WritesOnlyChangesAtMostOncePerInterval) {
    const fs::path folder = fresh_test_folder();
    Autosave editor(folder);
    for (int i = 0; i < 10; ++i) editor.update("boxes", with_bias(0.1), i);
    EXPECT_EQ(files_in(folder, ".json"), 0u) << "nothing was changed";
    const auto written = [&] {
        for (const auto& entry : fs::directory_iterator(folder / "sessions"))
            if (entry.path().extension() == ".json") return load_preset(entry.path().string()).settings.bias.constant;
        return -1.0;
    };
    editor.update("boxes", with_bias(1), 20);
    EXPECT_EQ(written(), 1) << "the first change at once";
    editor.update("boxes", with_bias(2), 20 + 0.5 * Autosave::kSeconds);
    EXPECT_EQ(written(), 1) << "the next not so soon";
    editor.update("boxes", with_bias(3), 20 + 1.01 * Autosave::kSeconds);
    EXPECT_EQ(written(), 3) << "but then the latest";
    editor.update("boxes", with_bias(0.1), 60);
    EXPECT_EQ(written(), 0.1) << "back to the start is a change too";
    editor.update("stage", with_bias(0.1), 90);
    EXPECT_EQ(files_in(folder, ".json"), 1u);
}

TEST(Autosave, SessionsOfRunningEditorsAreNotOffered) {
    const fs::path folder = fresh_test_folder();
    auto first = std::make_unique<Autosave>(folder), second = std::make_unique<Autosave>(folder);
    first->update("boxes", with_bias(0.1), 0);
    second->update("boxes", with_bias(0.1), 0);
    first->update("boxes", with_bias(11), 1);
    second->update("stage", with_bias(22), 1);
    EXPECT_EQ(files_in(folder, ".json"), 2u) << "each has its own";
    EXPECT_EQ(Autosave(folder).lost(), nullptr);
    second.reset();  // crashes; the first continues
    Autosave third(folder);
    ASSERT_NE(third.lost(), nullptr);
    EXPECT_EQ(third.lost()->preset.settings.bias.constant, 22);
    EXPECT_EQ(Autosave(folder).lost(), nullptr) << "two editors were offered one session";
    third.forget_lost();
    first->update("boxes", with_bias(12), 50);
    first->end("boxes", with_bias(12), false);
    EXPECT_EQ(files_in(folder, ".json"), 0u);
}

TEST(Autosave, SessionOfAnEndingProgramIsOfferedLater) {
    const fs::path folder = fresh_test_folder();
    auto ending = std::make_unique<Autosave>(folder);
    ending->update("boxes", with_bias(0.1), 0);
    ending->update("boxes", with_bias(11), 1);
    Autosave next(folder);
    next.update("boxes", with_bias(0.1), 0);
    EXPECT_EQ(next.lost(), nullptr);
    ending.reset();
    next.update("boxes", with_bias(0.1), 1.01 * Autosave::kSeconds);
    ASSERT_NE(next.lost(), nullptr);
    EXPECT_EQ(next.lost()->preset.settings.bias.constant, 11);
}

TEST(Autosave, SeveralLostSessionsAreOfferedInTurn) {
    const fs::path folder = fresh_test_folder();
    {
        Autosave a(folder), b(folder);
        for (Autosave* editor : {&a, &b}) editor->update("boxes", with_bias(0.1), 0);
        a.update("boxes", with_bias(1), 1);
        b.update("boxes", with_bias(2), 1);
    }
    Autosave next(folder);
    std::vector<double> offered;
    for (; next.lost(); next.forget_lost()) offered.push_back(next.lost()->preset.settings.bias.constant);
    std::sort(offered.begin(), offered.end());
    EXPECT_EQ(offered, (std::vector<double>{1, 2}));
}

TEST(Autosave, NewestComesFirstAndReusedProcessIdsLoseNothing) {
    const fs::path folder = fresh_test_folder();
    // All crashes of this test have one process number, as with reused numbers.
    for (const double bias : {1.0, 2.0, 3.0}) crash(folder, bias);
    EXPECT_EQ(files_in(folder, ".json"), 3u) << "one session was written over another";
    for (const auto& entry : fs::directory_iterator(folder / "sessions")) {
        if (entry.path().extension() != ".json") continue;
        const double bias = load_preset(entry.path().string()).settings.bias.constant;
        const auto hours = std::chrono::hours(bias == 3 ? 5 : bias == 2 ? 1 : 9);
        fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - hours);
    }
    const Autosave next(folder);
    ASSERT_NE(next.lost(), nullptr);
    EXPECT_EQ(next.lost()->preset.settings.bias.constant, 2) << "an hour old, not five";
    EXPECT_NEAR(next.lost()->age_s, 3600, 60);
}

TEST(Autosave, SceneFilesAreStoredWithAbsolutePaths) {
    const fs::path folder = fresh_test_folder();
    crash(folder, 5, "models/chair.glb");
    const Autosave next(folder);
    ASSERT_NE(next.lost(), nullptr);
    EXPECT_EQ(next.lost()->preset.scene, fs::absolute("models/chair.glb").string());
}

TEST(Autosave, BrokenSessionsAreRenamedWithAWarning) {
    const fs::path folder = fresh_test_folder();
    crash(folder, 9);
    fs::create_directories(folder / "sessions" / "folder.json");
    std::ofstream(folder / "sessions" / "1-0.json") << "{\"format\": \"shadow-ins";  // newer, so read first
    Autosave next(folder);
    ASSERT_NE(next.lost(), nullptr) << "a broken file hides a good one";
    EXPECT_EQ(next.lost()->preset.settings.bias.constant, 9);
    next.forget_lost();
    const auto remarks = next.take_remarks();
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_NE(remarks[0].find("1-0.json"), std::string::npos);
    EXPECT_TRUE(Autosave(folder).take_remarks().empty()) << "told once";
    EXPECT_EQ(files_in(folder, ".unreadable"), 1u) << "nothing is thrown away";
}

TEST(Autosave, RestoredSessionIsWrittenBeforeItsOldFileIsRemoved) {
    const fs::path folder = fresh_test_folder();
    crash(folder, 7);
    {
        Autosave editor(folder);
        ASSERT_NE(editor.lost(), nullptr);
        editor.adopt_lost();
        EXPECT_EQ(editor.lost(), nullptr);
        EXPECT_EQ(Autosave(folder).lost(), nullptr) << "two editors have one session";
    }
    {
        Autosave editor(folder);
        ASSERT_NE(editor.lost(), nullptr) << "lost by a crash before the next write";
        editor.adopt_lost();
        editor.update("boxes", with_bias(7), 0);
        EXPECT_EQ(files_in(folder, ".json"), 1u) << "the new file alone";
    }
    {
        Autosave editor(folder);
        ASSERT_NE(editor.lost(), nullptr) << "lost by a crash after the first scene was the restored one";
        EXPECT_EQ(editor.lost()->preset.settings.bias.constant, 7);
        editor.adopt_lost();
        editor.update("boxes", with_bias(7), 0);
        editor.end("boxes", with_bias(7), true);
    }
    Autosave last(folder);
    ASSERT_NE(last.lost(), nullptr) << "lost by quitting";
    last.adopt_lost();
    last.end("boxes", with_bias(7), false);
    EXPECT_EQ(files_in(folder, ".json"), 0u) << "it was saved";
    EXPECT_EQ(files_in(folder, ".lock"), 0u);
}

TEST(Autosave, FailedWriteIsTriedAgainAndKeepsTheLastCopy) {
    const fs::path folder = fresh_test_folder();
    const std::string unnameable = "not UTF-8: \xff.gltf";  // no preset can name this scene
    {
        Autosave editor(folder);
        editor.update("boxes", with_bias(0.1), 0);
        editor.update("boxes", with_bias(1), 10);
        editor.update(unnameable, with_bias(2), 20);
        editor.update(unnameable, with_bias(3), 30);
        EXPECT_EQ(editor.take_remarks().size(), 1u) << "told once";
        editor.update("stage", with_bias(4), 40);
        editor.update(unnameable, with_bias(5), 50);
        EXPECT_EQ(editor.take_remarks().size(), 1u);
        editor.end(unnameable, with_bias(6), true);
    }
    const Autosave next(folder);
    ASSERT_NE(next.lost(), nullptr) << "the end removed the last good copy";
    EXPECT_EQ(next.lost()->preset.scene, "stage");
    EXPECT_EQ(next.lost()->preset.settings.bias.constant, 4);
}

TEST(Autosave, UnwritableFolderIsOnlyAWarning) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "sessions") << "a file where a folder belongs";
    Autosave editor(folder);
    EXPECT_EQ(editor.lost(), nullptr);
    editor.update("boxes", with_bias(1), 0);
    for (int i = 1; i < 9; ++i) editor.update("boxes", with_bias(1 + i), 10 * i);
    EXPECT_EQ(editor.take_remarks().size(), 1u);
    editor.end("boxes", with_bias(9), true);
    Autosave off{fs::path()};
    off.update("boxes", with_bias(1), 0);
    off.update("boxes", with_bias(2), 10);
    off.end("boxes", with_bias(2), true);
    EXPECT_TRUE(off.take_remarks().empty());
}

}  // namespace
}  // namespace si
