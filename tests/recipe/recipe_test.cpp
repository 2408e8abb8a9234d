// Follows docs/recipes/filter-kernel.md in a copy of the source tree: the page's two blocks are the files
// (follow.cmake), its commands run, only the files that the page names change, and the tests over all kernels pass.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = SI_SOURCE_DIR;
const fs::path kPrograms = SI_RECIPE_PROGRAMS;
constexpr const char* kPage = "docs/recipes/filter-kernel.md";
constexpr const char* kFolders[] = {"app", "assets", "cmake", "docs", "renderer", "scripts", "shaders", "tests", "ui"};

/// Returns the relative paths of all files below the tree's folders, with their bytes.
std::map<std::string, std::string> files_of(const fs::path& tree) {
    std::map<std::string, std::string> out;
    for (const char* folder : kFolders)
        for (const auto& entry : fs::recursive_directory_iterator(tree / folder))
            if (entry.is_regular_file())
                out[fs::relative(entry.path(), tree).generic_string()] = file_bytes(entry.path());
    return out;
}

/// Returns the lines of the page's block of shell commands.
std::vector<std::string> commands(const std::string& page) {
    std::vector<std::string> out;
    const std::size_t from = page.find("```sh\n"), end = page.find("```\n", from + 6);
    if (from == std::string::npos || end == std::string::npos) return out;
    std::istringstream in(page.substr(from + 6, end - from - 6));
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

/// Returns the files that the page names in its sections on files to write, files to touch and commands.
std::set<std::string> files_named(const std::string& page) {
    std::set<std::string> out;
    static const std::regex first("(^|\n)(- )?`([A-Za-z0-9_/.-]+\\.(glsl|cpp|png|md))`");
    const std::string part = page.substr(page.find("## Files to write"), page.find("## Tests") - page.find("## Files"));
    for (std::sregex_iterator it(part.begin(), part.end(), first), end; it != end; ++it) out.insert((*it)[3]);
    return out;
}

/// Runs tests of a suite with the new row, in the copy of the tree, and expects them to pass. $SI_WHOLE_SUITES runs all
/// tests.
/// @param least smallest accepted number of run tests
void expect_green(const fs::path& tree, const std::string& suite, const std::string& filter, int least) {
    const std::string all = std::getenv("SI_WHOLE_SUITES") ? std::string("*") : filter;
    const ProcessResult r =
        run_shell(fmt::format("SI_SOURCE_TREE='{}' LIBGL_ALWAYS_SOFTWARE=1 '{}' --gtest_brief=1 "
                              "--gtest_filter='{}'",
                              tree.string(), (kPrograms / suite).string(), all));
    EXPECT_EQ(r.code, 0) << suite << "\n" << r.out << r.err;
    std::smatch count;
    ASSERT_TRUE(std::regex_search(r.out, count, std::regex("PASSED  \\] ([0-9]+) test"))) << suite << "\n" << r.out;
    EXPECT_GE(std::stoi(count[1]), least) << suite << " ran too few tests of " << filter;
}

/// Returns the lines of `after` that `before` lacks. The others must stand in the same order.
std::vector<std::string> added_lines(const std::string& before, const std::string& after) {
    std::vector<std::string> out;
    std::istringstream old(before), now(after);
    std::string expected;
    bool more = bool(std::getline(old, expected));
    for (std::string line; std::getline(now, line);)
        if (more && line == expected)
            more = bool(std::getline(old, expected));
        else
            out.push_back(line);
    EXPECT_FALSE(more) << "a line is missing: " << expected;
    return out;
}

TEST(FilterKernelRecipe, ItsFilesAndCommandsSuffice) {
    const std::string page = file_bytes(kSource / kPage);
    const fs::path tree = fresh_test_folder() / "tree";
    for (const char* folder : kFolders) {
        fs::create_directories(tree / folder);
        fs::copy(kSource / folder, tree / folder, fs::copy_options::recursive);
    }
    // These files of the recipe are compiled into the programs.
    std::smatch key, file;
    ASSERT_TRUE(std::regex_search(page, key, std::regex("\\.key = \"([^\"]+)\"")));
    ASSERT_TRUE(std::regex_search(page, file, std::regex("\\.file = \"([^\"]+)\"")));
    const std::string name = key[1], shader = "shaders/" + file[1].str();
    ASSERT_FALSE(fs::exists(kSource / shader)) << "the page's kernel is one that the program has";
    for (const std::string& path : {shader, std::string("renderer/settings/filters.cpp")})
        fs::copy_file(fs::path(SI_RECIPE_TREE) / path, tree / path, fs::copy_options::overwrite_existing);

    const std::vector<std::string> lines = commands(page);
    ASSERT_EQ(lines.size(), 2u) << "the recipe is one command, and the tests";
    ASSERT_EQ(lines[0], "scripts/document_technique.sh filter.kernel=" + name);
    ASSERT_EQ(lines[1], "./test.sh");
    const std::string script = fmt::format("'{}'/scripts/document_technique.sh --programs '{}' filter.kernel={}",
                                           tree.string(), kPrograms.string(), name);
    const ProcessResult r = run_shell(script);
    ASSERT_EQ(r.code, 0) << r.out << r.err;

    // Changed files are exactly those that the page names.
    const auto before = files_of(kSource), after = files_of(tree);
    std::set<std::string> changed;
    for (const auto& [path, bytes] : after)
        if (const auto it = before.find(path); it == before.end() || it->second != bytes) changed.insert(path);
    for (const auto& [path, bytes] : before) EXPECT_TRUE(after.contains(path)) << path << " is gone";
    EXPECT_EQ(changed, files_named(page));
    const auto rows = added_lines(before.at("docs/techniques.md"), after.at("docs/techniques.md"));
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_NE(rows[0].find("`" + name + "`"), std::string::npos) << rows[0];

    // The tests over all kernels.
    std::string of_row = name;
    std::ranges::replace(of_row, '-', '_');
    expect_green(tree, "test_unit", "TechniquesPage.*:Recipes.*:SweepAxes*:TexelUsage*:SettingsOwned.*", 12);
    expect_green(tree, "test_gl", fmt::format("*EachSquareKernel*/{}_*:*GoldenTest*/filters:GoldenPictures.*", of_row),
                 3);
    expect_green(tree, "test_invariant", fmt::format("*/{}_*", of_row), 11);
    const ProcessResult check =
        run_shell(fmt::format("'{}' docs settings -o '{}' --check", (kPrograms / "shadow-inspector").string(),
                              (tree / "docs/settings.md").string()));
    EXPECT_EQ(check.code, 0) << check.err;

    // Drawing the row again gives the same bytes.
    const ProcessResult again =
        run_shell(fmt::format("LIBGL_ALWAYS_SOFTWARE=1 '{}' docs techniques -o '{}' --only "
                              "filter.kernel={} --check",
                              (kPrograms / "shadow-inspector").string(), (tree / "docs/techniques.md").string(), name));
    EXPECT_EQ(again.code, 0) << again.err;

    // Without the command the tests fail.
    fs::copy_file(kSource / "docs/techniques.md", tree / "docs/techniques.md", fs::copy_options::overwrite_existing);
    const ProcessResult undocumented =
        run_shell(fmt::format("SI_SOURCE_TREE='{}' '{}' --gtest_brief=1 --gtest_filter='TechniquesPage.*'",
                              tree.string(), (kPrograms / "test_unit").string()));
    EXPECT_EQ(undocumented.code, 1) << undocumented.out;
}

TEST(DocumentTechnique, RefusesUnknownRowsAndOptions) {
    const fs::path tree = fresh_test_folder();
    for (const char* folder : {"docs", "scripts", "tests/golden"}) {
        fs::create_directories(tree / folder);
        fs::copy(kSource / folder, tree / folder, fs::copy_options::recursive);
    }
    const auto run = [&](const std::string& arguments) {
        return run_shell(fmt::format("'{}'/scripts/document_technique.sh --programs '{}' {}", tree.string(),
                                     kPrograms.string(), arguments));
    };
    const ProcessResult unknown = run("filter.kernel=tent4");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_NE(unknown.err.find("did you mean filter.kernel=tent"), std::string::npos) << unknown.err;
    for (const char* wrong : {"", "tent3", "--row=tent3", "filter.kernel=hard filter.kernel=pcf"}) {
        const ProcessResult r = run(wrong);
        EXPECT_EQ(r.code, 2) << wrong << r.err;
        EXPECT_NE(r.err.find("document_technique.sh: "), std::string::npos) << r.err;
    }
    EXPECT_EQ(run("--help").code, 0);
}

}  // namespace
}  // namespace si::test
