// The walls between the folders, and what must not stand in the sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

std::vector<fs::path> sources(const char* folder) {
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SI_SOURCE_DIR) / folder))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") out.push_back(entry.path());
    return out;
}

/// Files of a folder that include something the pattern matches.
std::vector<std::string> includers(const char* folder, const char* pattern) {
    const std::regex include("#include\\s*[<\"](" + std::string(pattern) + ")");
    std::vector<std::string> out;
    for (const fs::path& path : sources(folder))
        if (std::regex_search(text_of(path), include)) out.push_back(path.string());
    return out;
}

TEST(Architecture, DependenciesPointOneWay) {
    EXPECT_EQ(includers("renderer", "(imgui|GLFW/|EGL/|epoxy/egl|ui/|app/)"), std::vector<std::string>{});
    EXPECT_EQ(includers("ui", "(GLFW/|EGL/|epoxy/|app/)"), std::vector<std::string>{});
    EXPECT_FALSE(includers("app", "(GLFW/|epoxy/egl)").empty()) << "the search itself finds nothing";
}

TEST(Architecture, PanelsCallNoGl) {
    const std::regex call("\\bgl[A-Z][A-Za-z0-9]+\\s*\\(");
    for (const fs::path& path : sources("ui")) EXPECT_FALSE(std::regex_search(text_of(path), call)) << path;
}

}  // namespace
