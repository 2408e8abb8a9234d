// Tests of File, Report: menu, choice of presets, writing, refusals and cancelling in a real editor.
#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>
#include <fstream>

#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

SI_TEST_IS(Later, ReportDialogTest, TheMenuOpensItAndItsButtonRequestsAPage);
TEST(ReportDialogTest, TheMenuOpensItAndItsButtonRequestsAPage) {
    UiHarness ui(1280, 720);
    ui.frames(3);
    ui.click(ui.find("editor/top", "", "File"));
    ui.frames(2);
    ui.click(ui.find("##Popup", "", "Report…"));
    ui.frames(3);
    ASSERT_TRUE(ui.state.report.shown);
    EXPECT_EQ(ui.lacking({"attach to a bug", "The present settings", "Close"}), "");
    EXPECT_FALSE(ui.prints("The pinned settings A"));
    ui.state.pinned = PinnedSettings{ui.state.settings, "stage"};
    ui.state.report.presets = {"acne"};
    ui.type("mine.html");  // the path has the keyboard, and letters replace it
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"The pinned settings A", "acne", "Remove"}), "");
    const auto write = ui.find("Report", "", "Write");
    ASSERT_TRUE(write);
    ui.move(*write);
    ui.frames(2);
    const EditorRequests asked = ui.click_here();
    ASSERT_TRUE(asked.write_report);
    EXPECT_EQ(asked.write_report->output, "mine.html");
    EXPECT_TRUE(asked.write_report->pinned);
    EXPECT_FALSE(asked.write_report->replace);
    EXPECT_EQ(asked.write_report->presets, std::vector<std::string>{"acne"});
    ui.report.writing = SearchProgress{"acne: error", 0.3};
    ui.frames(2);
    EXPECT_EQ(ui.lacking({"30%", "acne: error", "Cancel"}), "");
}

TEST(ReportDialogTest, ReplacesOnlyTheFileThatItNamed) {
    for (const char* path : {"a.html", "b.html"}) {
        UiHarness ui(1280, 720);
        ui.report.taken = "a.html";
        ui.state.report.output = path;
        ui.state.report.asked = true;
        ui.frames(4);  // the path has the keyboard
        bool& enter = ImGui::GetIO().KeysDown[ImGui::GetKeyIndex(ImGuiKey_Enter)];
        enter = true;
        EditorRequests asked = ui.frame();
        enter = false;
        if (!asked.write_report) asked = ui.frame();
        ASSERT_TRUE(asked.write_report) << path;
        EXPECT_EQ(asked.write_report->output, path);
        EXPECT_EQ(asked.write_report->replace, path == ui.report.taken) << path;
    }
}

class EditorReport : public testing::Test {
protected:
    EditorReport() : editor_(editor_options("boxes", {"map.resolution=256"})) {}
    ReportFacts write(const ReportRequest& request) {
        EditorRequests requests = editor_.requests();
        requests.write_report = request;
        editor_.model().fulfil(requests);
        editor_.settle();
        return editor_.facts().report;
    }
    const fs::path folder_ = fresh_test_folder();
    TestEditor editor_;
};

TEST_F(EditorReport, WritesPresentPinnedAndPresetSettings) {
    Settings pinned = editor_.state().settings;
    pinned.map.resolution = 128;
    editor_.state().pinned = PinnedSettings{pinned, "boxes"};
    const std::string file = (folder_ / "r.html").string();
    ReportFacts facts = write({.output = file, .pinned = true, .presets = {"acne"}});
    EXPECT_EQ(facts.problem, "");
    EXPECT_EQ(editor_.last_line(), "Wrote " + file);
    const std::string html = file_bytes(file);
    for (const char* part : {"present settings", "pinned settings A", "acne", "map.resolution: 256 → 128",
                             "--set map.resolution=128", "data:image/svg+xml"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    facts = write({.output = file, .presets = {}});
    EXPECT_EQ(facts.taken, file);
    EXPECT_NE(facts.problem.find("the file exists"), std::string::npos);
    EXPECT_EQ(file_bytes(file), html);
    facts = write({.output = file, .replace = true, .presets = {}, .pixel = glm::ivec2(10, 20)});
    EXPECT_EQ(facts.problem, "");
    EXPECT_NE(file_bytes(file).find("Pixel 10,20"), std::string::npos);
}
SI_TEST_IS(Slow, EditorReport, WritesPresentPinnedAndPresetSettings);

TEST_F(EditorReport, FaultsAreSentencesAndACancelWritesNothing) {
    EXPECT_NE(write({.output = (folder_ / "r.txt").string(), .presets = {}}).problem.find(".html"), std::string::npos);
    const std::string file = (folder_ / "r.html").string();
    EXPECT_NE(write({.output = file, .presets = {"acn"}}).problem.find("acne"), std::string::npos);
    EditorRequests requests = editor_.requests();
    requests.write_report = ReportRequest{.output = file, .presets = {"acne"}};
    editor_.model().fulfil(requests);
    EXPECT_TRUE(editor_.facts().report.writing);
    requests = editor_.requests();
    requests.cancel_report = true;
    editor_.model().fulfil(requests);
    editor_.settle();
    EXPECT_NE(editor_.facts().report.problem.find("Cancelled"), std::string::npos);
    EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace si::test
