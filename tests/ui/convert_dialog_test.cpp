// Tests of File, Convert: menu, preview, targets, saving and its refusals.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <filesystem>
#include <fstream>

#include "app/convert/targets.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

TEST(ConvertDialog, TheMenuOpensIt) {
    UiHarness ui(1280, 720);
    ui.frames(3);
    ui.click(ui.find("editor/top", "", "File"));
    ui.frames(2);
    ui.click(ui.find("##Popup", "", "Convert…"));
    ui.frames(2);
    EXPECT_TRUE(ui.state.convert.shown);
    EXPECT_TRUE(ui.prints("Convert to another engine"));
    ui.key(ImGui::GetKeyIndex(ImGuiKey_Escape));
    ui.frames(2);
    EXPECT_FALSE(ui.state.convert.shown);
}

TEST(ConvertDialog, ReplacesOnlyTheFileThatItNamed) {
    UiHarness ui(1280, 720);
    ui.conversion.emplace();
    ui.conversion->text = "code";
    ui.conversion->taken = "/a/a.gd";
    ui.state.convert.asked = true;
    // Clicks down the right edge of the dialog until the button below the code saves.
    const auto saved_to = [&](const char* path) -> EditorRequests {
        ui.state.convert.output = path;
        ui.frames(3);
        const ImGuiWindow* part = UiHarness::window("Convert to another engine");
        if (!part) return {};
        const ImRect dialog = part->RootWindow->Rect();
        for (float y = dialog.Max.y - 80; y < dialog.Max.y; y += 6) {
            ui.move({dialog.Max.x - 60, y});
            ui.frames(2);
            if (EditorRequests requests = ui.click_here(); requests.save_conversion) return requests;
        }
        return {};
    };
    const EditorRequests other = saved_to("/a/b.gd");
    EXPECT_EQ(other.save_conversion, "/a/b.gd");
    EXPECT_FALSE(other.replace_conversion);
    const EditorRequests same = saved_to("/a/a.gd");
    EXPECT_EQ(same.save_conversion, "/a/a.gd");
    EXPECT_TRUE(same.replace_conversion);
}

/// Editor with the dialog open, in a folder of its own.
class ConvertPreview : public testing::Test {
protected:
    ConvertPreview() : editor_(editor_options("boxes", {"bias.kind=constant", "bias.constant=1.5"})) {
        editor_.state().files.preset_path = (folder_ / "p.json").string();
        editor_.state().convert.asked = true;
        settle();
    }
    void settle() {
        editor_.frames(4);
        editor_.settle();
        editor_.frames(2);
    }
    const ConvertFacts& facts() {
        static const ConvertFacts kNone;
        const ConvertFacts* shown = editor_.facts().conversion;
        EXPECT_TRUE(shown);
        return shown ? *shown : kNone;
    }
    void choose(const std::string& target) {
        editor_.state().convert.target = target;
        settle();
    }
    void save(const std::string& path, bool replace = false) {
        EditorRequests requests = editor_.requests();
        requests.save_conversion = path;
        requests.replace_conversion = replace;
        editor_.model().fulfil(requests);
    }

    const fs::path folder_ = fresh_test_folder();
    TestEditor editor_;
};

SI_TEST_IS(Later, ConvertPreview, ShowsTheCodeOfEveryTarget);
TEST_F(ConvertPreview, ShowsTheCodeOfEveryTarget) {
    ASSERT_EQ(facts().targets.size(), convert_targets().size());
    for (const ConvertTarget& target : convert_targets()) {
        choose(std::string(target.name));
        EXPECT_EQ(facts().problem, "") << target.name;
        EXPECT_NE(facts().text.find(target.title), std::string::npos) << target.name;
        EXPECT_NE(facts().text.find("as the shown map is fitted"), std::string::npos) << target.name;
    }
}

SI_TEST_IS(Later, ConvertPreview, FollowsSettingsAndAngle);
TEST_F(ConvertPreview, FollowsSettingsAndAngle) {
    choose("three");
    const std::string before = facts().text;
    editor_.state().settings.bias.constant = 3;
    settle();
    const std::string changed = facts().text;
    EXPECT_NE(changed, before);
    editor_.state().convert.angle_deg = 30;
    settle();
    EXPECT_NE(facts().text.find("reference angle 30 degrees"), std::string::npos);
    set_setting(editor_.state().settings, "map.virtual", "true");
    choose("glsl");
    EXPECT_EQ(facts().text, "");
    EXPECT_NE(facts().problem.find("set map.virtual to false"), std::string::npos) << facts().problem;
}

TEST_F(ConvertPreview, FollowsTheFrame) {
    choose("three");
    EXPECT_NE(facts().text.find("N 2048 texels"), std::string::npos) << facts().text;
    editor_.state().settings.map.resolution = 512;
    settle();
    EXPECT_NE(facts().text.find("N 512 texels"), std::string::npos) << facts().text;
}

SI_TEST_IS(Later, ConvertPreview, MeasuresAngleErrorAndTime);
TEST_F(ConvertPreview, MeasuresAngleErrorAndTime) {
    choose("three");
    EXPECT_EQ(facts().text.find("measured on"), std::string::npos);
    EditorRequests requests = editor_.requests();
    requests.measure_conversion = true;
    editor_.model().fulfil(requests);
    settle();
    EXPECT_TRUE(facts().measured);
    EXPECT_NE(facts().text.find("measured on boxes at"), std::string::npos) << facts().text;
    EXPECT_NE(facts().text.find("time "), std::string::npos);
    EXPECT_NE(facts().text.find("95 % of the scene's lit pixels are tilted less"), std::string::npos);
    EXPECT_NE(editor_.state().convert.angle_deg, 45);
    editor_.state().convert.angle_deg = 30;
    settle();
    EXPECT_NE(facts().text.find("30 degrees between normal and light (chosen"), std::string::npos) << facts().text;
    EXPECT_NE(facts().text.find("measured on"), std::string::npos) << "the angle changes no error";
    editor_.state().settings.bias.constant = 3;
    settle();
    EXPECT_FALSE(facts().measured);
    EXPECT_EQ(facts().text.find("measured on"), std::string::npos) << "of other settings";
}

TEST_F(ConvertPreview, SavesWholeAndReplacesOnlyWhenTold) {
    choose("godot");
    const std::string file = (folder_ / "out.gd").string();
    save(file);
    EXPECT_EQ(file_bytes(file), facts().text);
    EXPECT_EQ(editor_.last_line(), "Wrote " + file);
    std::ofstream(file) << "mine";
    save(file);
    EXPECT_EQ(facts().taken, file);
    EXPECT_NE(facts().problem.find("press Replace"), std::string::npos);
    EXPECT_EQ(file_bytes(file), "mine");
    save(file, true);
    EXPECT_EQ(file_bytes(file), facts().text);
    EXPECT_EQ(facts().taken, "");
}

SI_TEST_IS(Later, ConvertPreview, RefusesWithAdvice);
TEST_F(ConvertPreview, RefusesWithAdvice) {
    choose("three");
    save((folder_ / "missing" / "a.js").string());
    EXPECT_NE(facts().problem.find("make it first"), std::string::npos) << facts().problem;
    std::ofstream(folder_ / "p.json") << "{}";
    save((folder_ / "p.json").string(), true);
    EXPECT_NE(facts().problem.find("name another file"), std::string::npos) << facts().problem;
    EXPECT_EQ(file_bytes(folder_ / "p.json"), "{}");
}

}  // namespace
}  // namespace si::test
