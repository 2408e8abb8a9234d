// Tests of the editor's memory between runs: no stored file can break the editor.
#include "app/session/workspace.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <tuple>

#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;

TEST(Workspace, RemembersLayoutWindowAndRecentFiles) {
    const fs::path folder = fresh_test_folder() / "state" / "deep";
    {
        Workspace w(folder);
        EXPECT_EQ(w.data(), WorkspaceData{});
        w.change([](WorkspaceData& d) {
            d.layout = {.settings_width = 30,
                        .bottom_height = 12.5f,
                        .map_share = 0.25f,
                        .map_plots = false,
                        .light_theme = true,
                        .desktop_dialogs = false};
            d.welcomed = true;
            d.window_width = 1400;
            d.window_height = 800;
            d.maximised = true;
            put_first(d.recent_scenes, "/a/b.glb");
            put_first(d.recent_presets, "/a/\xc3\xa4 \"p\".json");
        });
    }
    const Workspace again(folder);
    EXPECT_EQ(again.data().layout, (EditorLayout{.settings_width = 30,
                                                 .bottom_height = 12.5f,
                                                 .map_share = 0.25f,
                                                 .map_plots = false,
                                                 .light_theme = true,
                                                 .desktop_dialogs = false}));
    EXPECT_TRUE(again.data().welcomed);
    EXPECT_EQ(again.data().window_width, 1400);
    EXPECT_EQ(again.data().window_height, 800);
    EXPECT_TRUE(again.data().maximised);
    EXPECT_EQ(again.data().recent_scenes, std::vector<std::string>{"/a/b.glb"});
    EXPECT_EQ(again.data().recent_presets, std::vector<std::string>{"/a/\xc3\xa4 \"p\".json"});
}

TEST(Workspace, RecentFilesAreNewestFirstWithoutRepeats) {
    std::vector<std::string> list;
    for (int i = 0; i < 30; ++i) put_first(list, std::to_string(i % 20));
    ASSERT_EQ(list.size(), 12u);
    EXPECT_EQ(list.front(), "9");
    EXPECT_EQ(list[1], "8");
    put_first(list, "5");
    EXPECT_EQ(list.front(), "5");
    EXPECT_EQ(std::count(list.begin(), list.end(), "5"), 1);
}

TEST(Workspace, TwoEditorsMergeTheirRecentFiles) {
    const fs::path folder = fresh_test_folder();
    Workspace a(folder), b(folder);
    a.change([](WorkspaceData& d) { put_first(d.recent_scenes, "/one.glb"); });
    b.change([](WorkspaceData& d) { put_first(d.recent_scenes, "/two.glb"); });
    a.change([](WorkspaceData& d) { d.layout.map_share = 0.5f; });
    EXPECT_EQ(Workspace(folder).data().recent_scenes, (std::vector<std::string>{"/two.glb", "/one.glb"}));
    EXPECT_EQ(Workspace(folder).data().layout.map_share, 0.5f);
}

TEST(Workspace, ForeignAndBrokenFilesAreAWarningAndStay) {
    const fs::path folder = fresh_test_folder();
    const std::string deep = R"({"format":"shadow-inspector-workspace","version":1,"layout":)" +
                             std::string(100'000, '[') + std::string(100'000, ']') + "}";
    for (const char* text : {"", "{", "[1]", deep.c_str(), "not json", R"({"format":"something else","version":1})",
                             R"({"format":"shadow-inspector-workspace","version":2})"}) {
        std::ofstream(folder / "workspace.json") << text;
        Workspace w(folder);
        EXPECT_EQ(w.data(), WorkspaceData{}) << text;
        w.change([](WorkspaceData& d) { put_first(d.recent_scenes, "/one.glb"); });
        EXPECT_EQ(w.data().recent_scenes.size(), 1u) << "it still works in this run";
        const auto remarks = w.take_remarks();
        ASSERT_EQ(remarks.size(), 1u) << text;
        EXPECT_NE(remarks[0].find("workspace.json"), std::string::npos);
        EXPECT_EQ(file_bytes(folder / "workspace.json"), text) << "a file that is not ours was written over";
    }
}

TEST(Workspace, MembersOfWrongTypeKeepTheirDefaults) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "workspace.json")
        << R"({"format":"shadow-inspector-workspace","version":1,"layout":{"settings_width":-5,"bottom_height":"tall",
               "map_share":0.3},"window":{"width":1e9,"height":600},"recent_scenes":[1,"/a.glb",null],"recent_presets":7})";
    Workspace w(folder);
    EXPECT_EQ(w.data().layout, (EditorLayout{.map_share = 0.3f}));
    EXPECT_EQ(w.data().window_width, 0);
    EXPECT_EQ(w.data().window_height, 0);
    EXPECT_EQ(w.data().recent_scenes, std::vector<std::string>{"/a.glb"});
    EXPECT_TRUE(w.data().recent_presets.empty());
    EXPECT_TRUE(w.take_remarks().empty());
}

/// A layout of an earlier version had one strip, which was always open, and no inspector.
TEST(Workspace, LayoutOfAnEarlierVersionKeepsItsSizesAndAClosedStrip) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "workspace.json")
        << R"({"format":"shadow-inspector-workspace","version":1,"layout":{"settings_width":30,"bottom_height":27,
               "map_place":1,"light_theme":true}})";
    Workspace w(folder);
    EXPECT_EQ(w.data().layout, (EditorLayout{.settings_width = 30,
                                             .bottom_height = 27,
                                             .strip_open = false,
                                             .map_place = MapSpot::NextToScene,
                                             .light_theme = true}));
    w.change([](WorkspaceData& d) { d.layout.strip_open = true; });
    EXPECT_TRUE(Workspace(folder).data().layout.strip_open);
    EXPECT_TRUE(w.take_remarks().empty());
}

TEST(Workspace, UnwritableFolderIsOnlyAWarning) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "file") << "no folder";
    Workspace w(folder / "file");
    w.change([](WorkspaceData& d) { d.layout.map_share = 0.5f; });
    w.change([](WorkspaceData& d) { d.layout.map_share = 0.6f; });
    EXPECT_EQ(w.data().layout.map_share, 0.6f);
    EXPECT_EQ(w.take_remarks().size(), 1u);
    Workspace off{fs::path()};
    off.change([](WorkspaceData& d) { d.layout.map_share = 0.5f; });
    EXPECT_EQ(off.data().layout.map_share, 0.5f);
    EXPECT_TRUE(off.take_remarks().empty());
}

TEST(Workspace, FoldersFollowTheXdgBaseDirectorySpecification) {
    const auto with = [](const char* variable, const char* value, const char* home, fs::path (*folder)()) {
        const auto put = [](const char* name, const char* to) { to ? setenv(name, to, 1) : unsetenv(name); };
        const char *old = std::getenv(variable), *old_home = std::getenv("HOME");
        const std::optional<std::string> o = old ? std::optional<std::string>(old) : std::nullopt,
                                         h = old_home ? std::optional<std::string>(old_home) : std::nullopt;
        put(variable, value);
        put("HOME", home);
        const fs::path found = folder();
        put(variable, o ? o->c_str() : nullptr);
        put("HOME", h ? h->c_str() : nullptr);
        return found;
    };
    for (const auto& [variable, folder, by_default] :
         {std::tuple{"XDG_STATE_HOME", &state_folder, "/h/.local/state/shadow-inspector"},
          {"XDG_CACHE_HOME", &cache_folder, "/h/.cache/shadow-inspector"}}) {
        EXPECT_EQ(with(variable, "/s", "/h", folder), "/s/shadow-inspector");
        EXPECT_EQ(with(variable, nullptr, "/h", folder), by_default);
        EXPECT_EQ(with(variable, "", "/h", folder), by_default);
        EXPECT_EQ(with(variable, "relative", "/h", folder), by_default);
        EXPECT_EQ(with(variable, nullptr, nullptr, folder), fs::path());
    }
}

}  // namespace
}  // namespace si
