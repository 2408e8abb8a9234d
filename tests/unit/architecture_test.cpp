// Tests of the order of folders and of forbidden texts in sources.
//
// Folders of renderer/ are ordered too: a file includes files of its own folder and of lower ones.
// docs/architecture/folders.dot draws the order.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/source_tree.h"
#include "tests/support/text.h"

namespace {

namespace fs = std::filesystem;

/// Returns the C++ sources and headers below a folder.
std::vector<fs::path> sources(std::string_view folder) {
    return si::test::source_files({folder}, {".h", ".cpp"});
}

/// Returns the files of a folder that include a header whose name matches the pattern.
std::vector<std::string> includers(const char* folder, const char* pattern) {
    const std::regex include("#include\\s*[<\"](" + std::string(pattern) + ")");
    std::vector<std::string> out;
    for (const fs::path& path : sources(folder))
        if (std::regex_search(si::file_bytes(path), include)) out.push_back(path.string());
    return out;
}

TEST(Architecture, DependenciesPointOneWay) {
    EXPECT_EQ(includers("renderer", "(imgui|GLFW/|EGL/|epoxy/egl|ui/|app/)"), std::vector<std::string>{});
    EXPECT_EQ(includers("ui", "(GLFW/|EGL/|epoxy/|app/)"), std::vector<std::string>{});
    EXPECT_FALSE(includers("app", "(GLFW/|epoxy/egl)").empty()) << "the search itself finds nothing";
}

/// Folders of renderer/ from low to high.
constexpr std::array<std::string_view, 27> kFolders = {
    "base",        "foreign",       "projection",   "gl",        "software",     "settings",    "profiles",
    "scene",       "gltf",          "bundle",       "importers", "scenes",       "view/lights", "bias",
    "view/bounds", "view/cascades", "view/culling", "view/fits", "view/cameras", "frame",       "optimisations",
    "reference",   "passes",        "render",       "inspect",   "measure",      "advise"};

/// Include of one file of renderer/ by another, both as paths below renderer/.
struct Include {
    std::string by, of;
};

std::vector<Include> renderer_includes() {
    std::vector<Include> out;
    const fs::path root = fs::path(SI_SOURCE_DIR) / "renderer";
    for (const fs::path& path : sources("renderer")) {
        std::istringstream lines(si::file_bytes(path));
        constexpr std::string_view kStart = "#include \"renderer/";
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with(kStart))
                out.push_back({path.lexically_relative(root).generic_string(),
                               line.substr(kStart.size(), line.find('"', kStart.size()) - kStart.size())});
    }
    return out;
}

/// Returns the rank of a file's folder in kFolders, from 0; their count for an unlisted folder.
std::ptrdiff_t rank_of(const std::string& file) {
    return std::ranges::find(kFolders, fs::path(file).parent_path().generic_string()) - kFolders.begin();
}

/// Units by name, each with the units that it includes.
using Units = std::map<std::string, std::set<std::string>>;

/// Returns the first include cycle on a walk from `unit`, from a unit to itself; empty without one.
/// @param path units from the start of the walk to `unit`
/// @param done units that reach no cycle
std::vector<std::string> include_cycle_from(const Units& units, const std::string& unit, std::vector<std::string>& path,
                                            std::set<std::string>& done) {
    if (done.contains(unit)) return {};
    const auto met = std::ranges::find(path, unit);
    if (met != path.end()) {
        std::vector<std::string> circle(met, path.end());
        circle.push_back(unit);
        return circle;
    }
    path.push_back(unit);
    if (const auto found = units.find(unit); found != units.end())
        for (const std::string& next : found->second)
            if (std::vector<std::string> circle = include_cycle_from(units, next, path, done); !circle.empty())
                return circle;
    path.pop_back();
    done.insert(unit);
    return {};
}

/// Returns an include cycle of the units; empty without one.
std::vector<std::string> include_cycle(const Units& units) {
    std::set<std::string> done;
    for (const auto& [unit, included] : units) {
        std::vector<std::string> path;
        if (std::vector<std::string> circle = include_cycle_from(units, unit, path, done); !circle.empty())
            return circle;
    }
    return {};
}

TEST(Architecture, FoldersOfTheRendererHaveAnOrder) {
    const auto count = std::ptrdiff_t(kFolders.size());
    for (const std::string_view folder : kFolders)
        EXPECT_TRUE(fs::is_directory(fs::path(SI_SOURCE_DIR) / "renderer" / folder)) << folder;
    for (const fs::path& path : sources("renderer"))
        EXPECT_LT(rank_of(path.lexically_relative(fs::path(SI_SOURCE_DIR) / "renderer").generic_string()), count)
            << path << ": its folder has no place in kFolders";
    std::size_t read = 0;
    for (const Include& include : renderer_includes()) {
        EXPECT_LE(rank_of(include.of), rank_of(include.by))
            << "renderer/" << include.by << " includes renderer/" << include.of << " of a higher folder";
        ++read;
    }
    EXPECT_GT(read, 1000u);
}

/// Folders that can be reached from each of kFolders along arrows.
using Reach = std::map<std::string, std::set<std::string>>;

/// Returns the folders that each folder reaches in any number of steps. @param arrows single steps
Reach reach_of(Reach arrows) {
    // The order of folders guarantees that the reach of lower folders is complete.
    for (const std::string_view folder : kFolders) {
        std::set<std::string>& reached = arrows[std::string(folder)];
        for (const std::string& next : std::set<std::string>(reached))
            if (const auto found = arrows.find(next); found != arrows.end())
                reached.insert(found->second.begin(), found->second.end());
    }
    return arrows;
}

// The diagram leaves out implied arrows, so reachable folders are compared.
TEST(Architecture, DiagramOfFoldersShowsTheIncludes) {
    Reach drawn, included;
    const std::string dot = si::file_bytes(fs::path(SI_SOURCE_DIR) / "docs/architecture/folders.dot");
    const std::regex arrow("\"([a-z/]+)\" -> \"([a-z/]+)\"");
    const auto is_folder = [](const std::string& name) { return std::ranges::find(kFolders, name) != kFolders.end(); };
    for (std::sregex_iterator it(dot.begin(), dot.end(), arrow), end; it != end; ++it)
        if (is_folder((*it)[1]) && is_folder((*it)[2])) drawn[(*it)[1]].insert((*it)[2]);
    const auto folder_of = [](const std::string& file) { return fs::path(file).parent_path().generic_string(); };
    for (const Include& include : renderer_includes())
        if (folder_of(include.by) != folder_of(include.of))
            included[folder_of(include.by)].insert(folder_of(include.of));
    EXPECT_EQ(reach_of(drawn), reach_of(included));
}

// A unit is a header with its source.
TEST(Architecture, UnitsOfTheRendererHaveNoIncludeCycle) {
    Units units;
    const auto unit_of = [](const std::string& file) { return file.substr(0, file.rfind('.')); };
    for (const Include& include : renderer_includes())
        if (unit_of(include.by) != unit_of(include.of)) units[unit_of(include.by)].insert(unit_of(include.of));
    EXPECT_GT(units.size(), 200u);
    EXPECT_EQ(include_cycle(units), std::vector<std::string>{});
    EXPECT_EQ(include_cycle({{"a", {"b", "c"}}, {"b", {"d"}}, {"c", {"d"}}}), std::vector<std::string>{});
    EXPECT_EQ(include_cycle({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}), (std::vector<std::string>{"b", "c", "b"}));
}

TEST(Architecture, PanelsCallNoGl) {
    const std::regex call("\\bgl[A-Z][A-Za-z0-9]+\\s*\\(");
    for (const fs::path& path : sources("ui")) EXPECT_FALSE(std::regex_search(si::file_bytes(path), call)) << path;
}

// One header defines texture units, for both languages.
TEST(Architecture, BindingsAreNamed) {
    const std::regex number("binding\\s*=\\s*[0-9]"), name("const int UNIT_\\w+ = (\\d+)");
    std::size_t read = 0;
    for (const char* folder : {"shaders", "renderer"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(SI_SOURCE_DIR) / folder)) {
            if (!entry.is_regular_file()) continue;
            EXPECT_FALSE(std::regex_search(si::file_bytes(entry.path()), number)) << entry.path();
            ++read;
        }
    EXPECT_GT(read, 100u);
    const std::string units = si::file_bytes(fs::path(SI_SOURCE_DIR) / "shaders/shared/units.h");
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
            const std::string text = si::file_bytes(path);
            std::smatch found;
            if (std::regex_search(text, found, cast)) ADD_FAILURE() << path << ": " << found.str();
        }
    EXPECT_TRUE(std::regex_search(std::string("x == int(Cull") + "::None)", cast)) << "the search itself finds nothing";

    const std::string settings = si::file_bytes(fs::path(SI_SOURCE_DIR) / "renderer/settings/settings.h");
    const std::regex enumeration("enum class (\\w+)");
    std::size_t read = 0;
    for (std::sregex_iterator it(settings.begin(), settings.end(), enumeration), end; it != end; ++it, ++read) {
        const std::regex number("int \\w+ = [^;]*;\\s*///<[^\\n]*\\b" + (*it)[1].str() + "\\b");
        EXPECT_FALSE(std::regex_search(settings, number)) << "a member that holds a " << (*it)[1] << " is an int";
    }
    EXPECT_GT(read, 30u);
}

// Texts for people are checked in the sources, since no test shows every tooltip.
TEST(Architecture, TextIsEncodedOnce) {
    std::size_t read = 0;
    const auto check = [&](const fs::path& path) {
        static const std::set<std::string> kText = {".h",   ".cpp",  ".glsl", ".json", ".js",
                                                    ".css", ".html", ".md",   ".sh",   ".txt"};
        if (!kText.contains(path.extension().string())) return;
        EXPECT_EQ(si::test::text_fault(si::file_bytes(path)), "") << path;
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
