// Tests of sweeps in the editor: run in a thread, kept in a journal, cancelled and continued.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/editor/sweep.h"
#include "app/sweep/files.h"
#include "app/sweep/results.h"
#include "renderer/base/error.h"
#include "tests/support/error_text.h"
#include "tests/support/fake_sweep.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "ui/state/panels.h"

namespace si {
namespace {

namespace fs = std::filesystem;

const SweepRequest kSweepRequest{{"filter.kernel=hard,pcf3", "map.resolution=64,256"}, 64, 48, false};

EditorOptions boxes(const fs::path& state = {}) {
    EditorOptions options = test::editor_options("boxes", {"map.resolution=512"});
    options.state_folder = state;
    options.tab = "frontier";
    return options;
}

struct Swept {
    HeadlessEditor editor;
    explicit Swept(const EditorOptions& options) : editor(options) {
        editor.model().state.sweep.follow = false;
        editor.settle();
    }
    EditorState& state() { return editor.model().state; }
    /// Measures the present settings in small pictures.
    void follow() {
        SweepPanel& panel = state().sweep;
        panel.width = 64;
        panel.height = 48;
        panel.follow = true;
    }
    const SweepFacts& facts() { return *editor.model().facts().sweep; }
    void ask(const std::function<void(EditorRequests&)>& what) {
        EditorRequests requests = editor.frame();
        what(requests);
        editor.model().fulfil(requests);
    }
    /// Waits for the first result. An editor that never idles would starve a software driver's threads.
    void wait_for_cases() {
        for (int i = 0; i < 20000 && facts().cases.empty(); ++i) {
            if (editor.model().measuring_moved()) editor.frame();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        ASSERT_FALSE(facts().cases.empty());
    }
};

SI_TEST_IS(Later, EditorSweep, MeasuresInTheBackground);
TEST(EditorSweep, MeasuresInTheBackground) {
    Swept s(boxes());
    s.ask([](EditorRequests& a) { a.start_sweep = kSweepRequest; });
    EXPECT_TRUE(s.editor.model().measuring());
    EXPECT_EQ(s.facts().total, 4u);
    s.state().settings.bias.normal = 0.7;
    s.editor.frame();  // does not wait
    s.editor.settle();
    ASSERT_EQ(s.facts().cases.size(), 4u) << s.facts().problem;
    EXPECT_FALSE(s.facts().running);
    EXPECT_EQ(s.facts().view.marks.size(), 4u) << "each has an error and a time";
    EXPECT_EQ(s.facts().other_settings.size(), 1u) << "the bias has changed since";
    s.ask([](EditorRequests& a) { a.apply_sweep_base = true; });
    s.editor.settle();
    EXPECT_TRUE(s.facts().other_settings.empty());
    EXPECT_NE(s.state().settings.bias.normal, 0.7);
}

TEST(EditorSweep, CurrentSettingsAreAMovingDotComparedWithThePrevious) {
    Swept s(boxes());
    EditorState& state = s.state();
    s.follow();
    state.settings.map.resolution = 64;
    s.editor.settle();
    ASSERT_TRUE(s.facts().view.present) << s.facts().present_problem;
    EXPECT_FALSE(s.facts().view.before) << "nothing was measured before";
    EXPECT_GT(s.facts().view.present->cost, 0) << "milliseconds";
    state.sweep.cost = "cost.map_texels";
    s.editor.settle();
    const Dot first = *s.facts().view.present;
    EXPECT_EQ(first.cost, 64 * 64);
    const auto at = [&](int resolution) {
        state.settings.map.resolution = resolution;
        s.editor.settle();
        ASSERT_TRUE(s.facts().view.present) << s.facts().present_problem;
        ASSERT_EQ(s.facts().view.present->cost, double(resolution) * resolution);
    };
    at(128);
    EXPECT_LT(s.facts().view.present->error, first.error);
    ASSERT_TRUE(s.facts().view.before && s.facts().before);
    EXPECT_EQ(s.facts().view.before->cost, 64 * 64);
    EXPECT_EQ(s.facts().view.before->error, first.error);
    EXPECT_EQ(s.facts().change, "Resolution: 64 \u2192 128 texels");
    EXPECT_FALSE(s.facts().before_is_pinned);
    state.settings.map.resolution = 64;
    pin_settings(state);
    at(256);
    EXPECT_EQ(s.facts().view.before->cost, 64 * 64) << "the pinned ones, not those measured last";
    EXPECT_TRUE(s.facts().before_is_pinned);
    state.settings.camera.source = CameraSource::Manual;
    state.settings.camera.azimuth += 20;
    s.editor.settle();
    EXPECT_FALSE(s.facts().view.before) << "of another picture";
}
SI_TEST_IS(Slow, EditorSweep, CurrentSettingsAreAMovingDotComparedWithThePrevious);

TEST(EditorSweep, PinnedSettingsAndDefaultsOfTheEngineAreMarksBesideThePresentOnes) {
    Swept s(boxes());
    EditorState& state = s.state();
    s.follow();
    state.sweep.cost = "cost.map_texels";
    state.settings.map.resolution = 128;
    pin_settings(state);
    state.settings.map.resolution = 64;
    state.engine_panel.profile = &engine_profile("three");
    s.editor.settle();
    const auto labels = [&] {
        std::vector<std::string> out;
        for (const PlotSpot& spot : s.facts().view.plot.spots) out.push_back(spot.label);
        return out;
    };
    EXPECT_EQ(labels(), (std::vector<std::string>{"three.js", "A", "now"}));
    ASSERT_TRUE(s.facts().view.before && s.facts().view.present && s.facts().engine);
    EXPECT_EQ(s.facts().view.before->cost, 128 * 128) << "though they were never shown while the panel was open";
    EXPECT_EQ(s.facts().view.present->cost, 64 * 64);
    EXPECT_NE(s.facts().view.plot.spots[0].dot.error, s.facts().view.present->error) << "the engine's own bias";
    const Dot present = *s.facts().view.present;
    s.ask([](EditorRequests& a) { a.cancel_sweep = true; });  // any change of the measuring thread's status
    ASSERT_TRUE(s.facts().view.present);
    EXPECT_EQ(s.facts().view.present->error, present.error) << "not the engine's, which were measured last";
    state.settings.map.resolution = 256;
    s.editor.frame();
    EXPECT_TRUE(s.facts().measuring_present);
    EXPECT_TRUE(s.facts().present_is_old);
    ASSERT_TRUE(s.facts().view.present);
    EXPECT_EQ(s.facts().view.present->error, present.error) << "of the settings before";
    state.settings.map.resolution = 64;
    s.editor.settle();
    ASSERT_TRUE(s.facts().view.present);
    EXPECT_EQ(s.facts().view.present->error, present.error);
    state.engine_panel.profile = nullptr;
    s.editor.settle();
    EXPECT_EQ(labels(), (std::vector<std::string>{"A", "now"}));
    state.settings.map.resolution = 128;
    s.editor.settle();
    EXPECT_EQ(labels().back(), "now");
    EXPECT_FALSE(s.facts().before_is_pinned) << "the pinned settings are the present ones";
}
SI_TEST_IS(Slow, EditorSweep, PinnedSettingsAndDefaultsOfTheEngineAreMarksBesideThePresentOnes);

SI_TEST_IS(Later, EditorSweep, CancelledSweepContinues);
TEST(EditorSweep, CancelledSweepContinues) {
    const fs::path state = fresh_test_folder();
    std::size_t kept = 0;
    {
        Swept s(boxes(state));
        s.ask([](EditorRequests& a) { a.start_sweep = kSweepRequest; });
        ASSERT_NO_FATAL_FAILURE(s.wait_for_cases());
        s.ask([](EditorRequests& a) { a.cancel_sweep = true; });
        s.editor.settle();
        EXPECT_FALSE(s.facts().running);
        EXPECT_TRUE(s.facts().problem.empty()) << s.facts().problem;
        kept = s.facts().cases.size();
        EXPECT_GT(kept, 0u);
    }
    const std::string journal = file_bytes(state / "sweep-1" / kJournalFile);
    ASSERT_FALSE(journal.empty());
    Swept s(boxes(state));
    s.ask([](EditorRequests& a) { a.start_sweep = kSweepRequest; });
    s.editor.settle();
    EXPECT_EQ(s.facts().cases.size(), 4u);
    EXPECT_TRUE(file_bytes(state / "sweep-1" / kJournalFile).starts_with(journal)) << "nothing is measured twice";
    // Another sweep replaces the finished one.
    SweepRequest other = kSweepRequest;
    other.axes = {"bias.normal=0,1"};
    s.ask([&](EditorRequests& a) { a.start_sweep = other; });
    s.editor.settle();
    EXPECT_EQ(s.facts().cases.size(), 2u);
    EXPECT_FALSE(fs::exists(state / "sweep-2"));
}

TEST(EditorSweep, CancelledBeforeItsFirstResultLeavesNothing) {
    const fs::path state = fs::path(SI_TEST_OUTPUT_DIR) / "sweep_left";
    fs::remove_all(state);
    fs::create_directories(state / "sweep-1");  // somebody else's folder
    Swept s(boxes(state));
    for (const bool existed : {true, false}) {
        s.ask([](EditorRequests& a) {
            a.start_sweep = kSweepRequest;
            a.cancel_sweep = true;
        });
        s.editor.settle();
        EXPECT_EQ(fs::exists(state / "sweep-1"), existed);
        fs::remove(state / "sweep-1");
    }
}

TEST(EditorSweep, CasesWithoutTimesArePlottedOverAnotherCost) {
    const fs::path state = fs::path(SI_TEST_OUTPUT_DIR) / "sweep_without_times";
    fs::remove_all(state);
    Swept s(boxes(state));
    SweepRequest request = kSweepRequest;
    request.axes = {"filter.kernel=hard,hw2x2,pcf3,pcf5", "map.resolution=64:2048:*2", "bias.slope=0,1,2"};
    s.ask([&](EditorRequests& a) { a.start_sweep = request; });
    const std::string chosen = s.state().sweep.cost;
    ASSERT_EQ(chosen, "shadow.moving_ms.median");
    ASSERT_NO_FATAL_FAILURE(s.wait_for_cases());
    ASSERT_FALSE(s.facts().timing) << "too fast for this test";
    EXPECT_EQ(s.facts().view.marks.size(), s.facts().cases.size()) << "shown as they come";
    EXPECT_NE(s.facts().cost, chosen);
    s.ask([](EditorRequests& a) { a.cancel_sweep = true; });
    s.editor.settle();
    EXPECT_FALSE(s.facts().running);
    EXPECT_GE(s.facts().view.marks.size() + 1, s.facts().cases.size()) << "but for one that was cancelled half-way";
    EXPECT_EQ(s.state().sweep.cost, chosen) << "it is still what is wanted";
    EXPECT_TRUE(fs::exists(state / "sweep-1")) << "what was found is worth keeping";
}

SI_TEST_IS(Later, EditorSweep, SavedAndOpenedSweepIsTheSame);
TEST(EditorSweep, SavedAndOpenedSweepIsTheSame) {
    const fs::path folder = fresh_test_folder();
    {
        Swept s(boxes());
        s.ask([](EditorRequests& a) { a.start_sweep = kSweepRequest; });
        s.editor.settle();
        s.ask([&](EditorRequests& a) { a.save_sweep = (folder / "out").string(); });
        EXPECT_EQ(s.state().log.unseen_errors(), 0);
    }
    for (const char* file : {"report.html", "results.csv", "results.json", "base.json", "pictures/0000.jpg"})
        EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
    EditorOptions options = boxes();
    options.sweep = folder / "out";
    Swept s(options);
    EXPECT_TRUE(s.state().shows(Page::Frontier));
    EXPECT_EQ(s.facts().cases.size(), 4u);
    EXPECT_EQ(s.facts().view.marks.size(), 4u);
    EXPECT_EQ(s.state().sweep.width, 64);
    ASSERT_EQ(s.state().sweep.axes.size(), 2u);
    EXPECT_EQ(s.state().sweep.axes[1].values, "64,256");
}

TEST(EditorSweep, SaveRefusesAFolderWithAnotherSweep) {
    const fs::path root = fresh_test_folder();
    const FakeSweep shown(root / "shown");
    FakeSweep other(root / "other");
    other.spec.width = 9;
    shown.measure();
    other.measure();
    const std::string journal = file_bytes(other.folder / kJournalFile);
    SweepPanel panel;
    EditorSweep sweep{fs::path()};
    sweep.open(shown.folder, panel);
    EXPECT_TRUE(test::fails_with([&] { sweep.save(other.folder); },
                                 {"other: holds another sweep (--size 9x8 there, 8x8 here); choose another folder"}));
    EXPECT_EQ(file_bytes(other.folder / kJournalFile), journal);
    EXPECT_FALSE(lacks_pictures(other.folder, 7));
}

TEST(EditorSweep, SaveReplacesTheSameSweepOnlyAsAWhole) {
    const fs::path root = fresh_test_folder();
    const FakeSweep shown(root / "shown"), saved(root / "saved");
    shown.measure();
    FakeMeter meter;
    saved.run(meter, 2);
    std::ofstream(saved.folder / "notes.txt") << "mine";
    const std::string journal = file_bytes(saved.folder / kJournalFile);
    SweepPanel panel;
    EditorSweep sweep{fs::path()};
    sweep.open(shown.folder, panel);
    const fs::path picture = shown.folder / picture_path(3);
    fs::remove(picture);
    fs::create_directory(picture);
    EXPECT_TRUE(test::fails_with([&] { sweep.save(saved.folder); }, {"cannot be copied"}));
    EXPECT_EQ(file_bytes(saved.folder / kJournalFile), journal);
    EXPECT_FALSE(lacks_pictures(saved.folder, 0));

    fs::remove(picture);
    std::ofstream(picture) << "jpg";
    sweep.save(saved.folder);
    EXPECT_EQ(file_bytes(saved.folder / kJournalFile), file_bytes(shown.folder / kJournalFile));
    EXPECT_FALSE(lacks_pictures(saved.folder, 7));
    EXPECT_TRUE(fs::exists(saved.folder / "report.html"));
    EXPECT_EQ(file_bytes(saved.folder / "notes.txt"), "mine");
    for (const auto& entry : fs::directory_iterator(saved.folder))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
}

TEST(EditorSweep, OpenedSweepEndsTheRunningOne) {
    const fs::path root = fresh_test_folder();
    const FakeSweep other(root / "other");
    other.measure();
    Swept s(boxes(root / "state"));
    s.ask([](EditorRequests& a) { a.start_sweep = kSweepRequest; });
    EXPECT_TRUE(s.facts().running);
    s.ask([&](EditorRequests& a) { a.open_sweep = other.folder.string(); });
    s.editor.settle();
    EXPECT_EQ(s.state().log.unseen_errors(), 0);
    EXPECT_EQ(s.facts().cases.size(), 8u);
    EXPECT_FALSE(s.facts().running);
    EXPECT_FALSE(s.facts().timing);
    EXPECT_EQ(s.facts().progress, 0);
    EXPECT_EQ(s.facts().seconds_left, 0);
    EXPECT_EQ(s.facts().current, "");
}

TEST(EditorSweep, ErrorsOfAnotherDefinitionAreNotOpened) {
    const FakeSweep old(fresh_test_folder());
    FakeMeter meter;
    old.run(meter, 2);
    const fs::path file = old.folder / kJournalFile;
    std::string text = file_bytes(file);
    const std::string number = "\"meaning\":" + std::to_string(kErrorMeaning);
    SweepPanel panel;
    EXPECT_NO_THROW(EditorSweep({}).open(old.folder, panel));
    const std::size_t at = text.find(number);
    ASSERT_NE(at, text.npos);
    std::ofstream(file, std::ios::binary) << text.replace(at, number.size(), "\"meaning\":7");
    EXPECT_THROW(EditorSweep({}).open(old.folder, panel), Error);
}

TEST(EditorSweep, ReportsAxesThatCannotBeSwept) {
    Swept s(boxes());
    SweepRequest request = kSweepRequest;
    request.axes = {"no.such=1"};
    s.ask([&](EditorRequests& a) { a.start_sweep = request; });
    ASSERT_FALSE(s.state().log.lines().empty());
    EXPECT_NE(s.state().log.lines().back().text.find("no.such"), std::string::npos);
    EXPECT_FALSE(s.editor.model().measuring());
    s.ask([](EditorRequests& a) { a.open_sweep = "/nonexistent/folder"; });
    EXPECT_NE(s.state().log.lines().back().text.find("/nonexistent/folder"), std::string::npos);
    s.ask([](EditorRequests& a) { a.save_sweep = "/nonexistent/folder"; });
    EXPECT_EQ(s.state().log.lines().back().kind, LogKind::Error);
}

}  // namespace
}  // namespace si
