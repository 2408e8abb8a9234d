// Tests of panel includes: panels with their own state do not reach another panel or the editor's state.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

namespace si::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEditorState = "ui/state/editor_ui.h";

/// Adds all headers of ui/ that a file includes, directly or indirectly.
void collect_includes(const std::string& file, std::set<std::string>& found) {
    static const std::regex kInclude(R"re(^#include "(ui/[^"]+)")re");
    std::ifstream in(fs::path(SI_SOURCE_DIR) / file);
    for (std::string line; std::getline(in, line);)
        if (std::smatch match; std::regex_search(line, match, kInclude) && found.insert(match[1]).second)
            collect_includes(match[1], found);
}

bool reaches_editor_state(const std::string& file) {
    std::set<std::string> found;
    collect_includes(file, found);
    return found.contains(kEditorState);
}

/// Panels that still use the whole state, and the two that hold all panels in tabs. Do not add panels.
const std::set<std::string> kWholeState = {"artefact_tour.cpp",  "error_panel.cpp",   "improve_panel.cpp",
                                           "objects_panel.cpp",  "preset_strips.cpp", "probe_panel.cpp",
                                           "settings_panel.cpp", "status_bar.cpp",    "top_bar.cpp",
                                           "welcome.cpp",        "inspector.cpp",     "strip.cpp"};

TEST(PanelIncludes, PanelsWithStateIncludeNoOtherPanel) {
    int own = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(SI_SOURCE_DIR) / "ui/panels")) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() != ".cpp") continue;
        EXPECT_EQ(reaches_editor_state("ui/panels/" + name), kWholeState.contains(name)) << name;
        own += !kWholeState.contains(name);
    }
    EXPECT_GE(own, 10);
}

TEST(PanelIncludes, PanelHeadersDoNotIncludeTheEditorState) {
    for (const auto& entry : fs::directory_iterator(fs::path(SI_SOURCE_DIR) / "ui/panels")) {
        if (entry.path().extension() != ".h") continue;
        const std::string name = entry.path().filename().string();
        EXPECT_FALSE(reaches_editor_state("ui/panels/" + name)) << name;
    }
    EXPECT_TRUE(reaches_editor_state("ui/state/panels.h")) << "the search itself finds nothing";
}

}  // namespace
}  // namespace si::test
