// The walls between the folders, and what must not stand in the sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/text.h"

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

// One header says where shaders find textures, for both languages.
TEST(Architecture, BindingsAreNamed) {
    const std::regex number("binding\\s*=\\s*[0-9]"), name("const int UNIT_\\w+ = (\\d+)");
    std::size_t read = 0;
    for (const char* folder : {"shaders", "renderer"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(SI_SOURCE_DIR) / folder)) {
            if (!entry.is_regular_file()) continue;
            EXPECT_FALSE(std::regex_search(text_of(entry.path()), number)) << entry.path();
            ++read;
        }
    EXPECT_GT(read, 100u);
    const std::string units = text_of(fs::path(SI_SOURCE_DIR) / "shaders/shared/units.h");
    std::set<std::string> taken;
    for (std::sregex_iterator it(units.begin(), units.end(), name), end; it != end; ++it)
        EXPECT_TRUE(taken.insert((*it)[1]).second) << it->str() << ": another one has that unit";
    EXPECT_GT(taken.size(), 10u);
}

// A choice is a member of its enumeration: only EnumRef (renderer/settings/param.h) turns one into a number and back.
// Arrays, shaders and files that hold an index take it by index_of().
TEST(Architecture, ChoicesAreTyped) {
    const std::regex cast("\\b(int|static_cast<int>)\\((si::)?[A-Z]\\w*::[A-Z]\\w*\\)");
    for (const char* folder : {"app", "renderer", "ui", "tests"})
        for (const fs::path& path : sources(folder)) {
            const std::string text = text_of(path);
            std::smatch found;
            if (std::regex_search(text, found, cast)) ADD_FAILURE() << path << ": " << found.str();
        }
    EXPECT_TRUE(std::regex_search(std::string("x == int(Cull") + "::None)", cast)) << "the search itself finds nothing";

    const std::string settings = text_of(fs::path(SI_SOURCE_DIR) / "renderer/settings/settings.h");
    const std::regex enumeration("enum class (\\w+)");
    std::size_t read = 0;
    for (std::sregex_iterator it(settings.begin(), settings.end(), enumeration), end; it != end; ++it, ++read) {
        const std::regex number("int \\w+ = [^;]*;\\s*///<[^\\n]*\\b" + (*it)[1].str() + "\\b");
        EXPECT_FALSE(std::regex_search(settings, number)) << "a member that holds a " << (*it)[1] << " is an int";
    }
    EXPECT_GT(read, 30u);
}

// What people read is written here, tooltips that no test hovers too.
TEST(Architecture, TextIsEncodedOnce) {
    std::size_t read = 0;
    const auto check = [&](const fs::path& path) {
        static const std::set<std::string> kText = {".h",   ".cpp",  ".glsl", ".json", ".js",
                                                    ".css", ".html", ".md",   ".sh",   ".txt"};
        if (!kText.contains(path.extension().string())) return;
        EXPECT_EQ(si::test::text_fault(text_of(path)), "") << path;
        ++read;
    };
    for (const char* folder : {"app", "renderer", "ui", "shaders", "assets", "docs", "scripts", "tests"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(SI_SOURCE_DIR) / folder))
            check(entry.path());
    check(fs::path(SI_SOURCE_DIR) / "README.md");
    EXPECT_GT(read, 400u);
    EXPECT_NE(si::test::text_fault("N\xc3\x82\xc2\xb7L"), "") << "a dot encoded twice";
    EXPECT_NE(si::test::text_fault("a \xe2\x80"), "");
    EXPECT_EQ(si::test::text_fault("\xc3\x97 \xc2\xb2 \xe2\x80\x9c caf\xc3\xa9 \xe2\x80\x9d"), "");
}

}  // namespace
