// Tests of docs/recipes: all pages have the same sections and name existing files, programs and tests. A technique's
// key stands only in its row and its shader.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/overlays.h"
#include "tests/support/process.h"
#include "tests/support/source_tree.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = test::source_tree();

/// Table of techniques: its row file, the folder of its GLSL files, and the rows' keys.
struct Table {
    std::string rows, folder, setting;
    std::vector<std::string> keys, files;
};

template <typename Row>
Table table(std::string rows, std::string folder, std::string setting, std::span<const Row> list) {
    Table t{std::move(rows), std::move(folder), std::move(setting), {}, {}};
    for (const Row& row : list) {
        t.keys.emplace_back(row.key);
        if constexpr (requires { row.file(); })
            t.files.push_back(row.file());
        else
            t.files.emplace_back(row.file);
    }
    return t;
}

std::vector<Table> tables() {
    return {table("renderer/settings/filters", "shaders/filters", "filter.kernel", filters()),
            table("renderer/settings/biases", "shaders/biases", "bias.kind", biases()),
            table("renderer/settings/overlays", "shaders/overlays", "view.overlay", overlays())};
}

/// Returns the text of each recipe by the name of its page.
std::map<std::string, std::string> recipes() {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::directory_iterator(kRoot / "docs/recipes"))
        out[entry.path().stem().string()] = file_bytes(entry.path());
    return out;
}

/// Returns the files that a recipe names in `code`, recognised by their endings.
std::vector<std::string> files_named(const std::string& recipe) {
    static const std::regex code("`([^`\n]+)`"),
        file("([A-Za-z0-9_*-]+/)*[A-Za-z0-9_.*-]+\\.(cpp|h|glsl|md|json|sh|png)");
    std::vector<std::string> out;
    for (std::sregex_iterator at(recipe.begin(), recipe.end(), code), end; at != end; ++at) {
        const std::string text = (*at)[1];
        for (std::sregex_iterator f(text.begin(), text.end(), file), none; f != none; ++f) out.push_back(f->str());
    }
    return out;
}

/// Returns whether a file of the tree has that path, from its root or from shaders/. NAME and * match any word, and a
/// bare name matches a file of any folder.
bool exists(const std::string& named) {
    std::string pattern;
    for (const char c : std::regex_replace(named, std::regex("NAME"), "*"))
        pattern += c == '*'                                  ? std::string("[A-Za-z0-9_-]+")
                   : std::isalnum(c) || c == '_' || c == '/' ? std::string(1, c)
                                                             : std::string("\\") + c;
    const std::regex whole((named.find('/') == std::string::npos ? "(.*/)?" : "(shaders/)?") + pattern);
    for (const char* folder : {"app", "renderer", "ui", "shaders", "tests", "docs", "assets", "scripts"})
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
            if (entry.is_regular_file() && std::regex_match(fs::relative(entry.path(), kRoot).generic_string(), whole))
                return true;
    return false;
}

SI_TESTS_ARE(Repeated, Recipes);
TEST(Recipes, NameFilesThatExist) {
    const auto all = recipes();
    std::size_t named = 0;
    for (const auto& [title, text] : all)
        for (const std::string& file : files_named(text)) {
            // The page's example is a kernel that the program lacks: tests/recipe adds it.
            if (file.find("binomial5") != std::string::npos) continue;
            EXPECT_TRUE(exists(file)) << "docs/recipes/" << title << ".md names " << file;
            ++named;
        }
    EXPECT_GT(named, 60u);
    EXPECT_FALSE(exists("shaders/filters/NAME.txt.glsl"));
    EXPECT_FALSE(exists("renderer/settings/sundials.cpp"));
}

TEST(Recipes, HaveAllSections) {
    const auto all = recipes();
    for (const char* name : {"filter-kernel", "source", "bias", "overlay", "fit", "setting", "metric", "effect",
                             "default", "scene", "preset", "hard-case"})
        EXPECT_TRUE(all.contains(name)) << "docs/recipes/" << name << ".md is missing";
    for (const auto& [name, text] : all)
        for (const char* section :
             {"## Files to write\n", "## Files to touch\n", "## Commands\n```sh\n", "## Tests that must be green\n"})
            EXPECT_NE(text.find(section), std::string::npos) << "docs/recipes/" << name << ".md lacks " << section;
}

/// Returns the names of suites in the sources of the tests: "GoldenTest" of TEST_P(GoldenTest, ...).
std::set<std::string> test_suites() {
    std::set<std::string> out;
    static const std::regex suite("TEST(_F|_P)?\\((\\w+),");
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests")) {
        if (entry.path().extension() != ".cpp") continue;
        const std::string text = file_bytes(entry.path());
        for (std::sregex_iterator it(text.begin(), text.end(), suite), end; it != end; ++it) out.insert((*it)[2]);
    }
    return out;
}

// The first cell of a table of tests names suites and their files: | `EachKernel` (`tests/invariant/rows_test.cpp`) |
// ... |
TEST(Recipes, NameTestsThatExist) {
    static const std::regex cell("`([A-Z]\\w+)`(?=[^|]*\\(`tests/)");
    const std::set<std::string> suites = test_suites();
    EXPECT_GT(suites.size(), 100u);
    for (const auto& [name, text] : recipes()) {
        const std::string tests = text.substr(std::min(text.find("## Tests that must be green"), text.size()));
        std::size_t named = 0;
        for (std::sregex_iterator it(tests.begin(), tests.end(), cell), end; it != end; ++it, ++named)
            EXPECT_TRUE(suites.contains((*it)[1])) << "docs/recipes/" << name << ".md names the test " << (*it)[1];
        EXPECT_GT(named, 0u) << "docs/recipes/" << name << ".md names no test";
    }
}

TEST(Recipes, NameTheRowsAndFilesOfEachTable) {
    std::string text;
    for (const auto& [title, recipe] : recipes()) text += recipe;
    for (const Table& t : tables()) {
        EXPECT_NE(text.find(t.rows + ".cpp"), std::string::npos) << t.rows;
        EXPECT_NE(text.find(t.folder + "/"), std::string::npos) << t.folder;
        for (const std::string& file : t.files) {
            EXPECT_TRUE(fs::exists(kRoot / "shaders" / file)) << file;
            EXPECT_EQ(fs::path("shaders" / fs::path(file)).parent_path(), t.folder) << file;
        }
        // A file without a row is a technique that no setting can select.
        for (const auto& entry : fs::directory_iterator(kRoot / t.folder))
            EXPECT_NE(std::ranges::find(t.files, fs::relative(entry.path(), kRoot / "shaders").generic_string()),
                      t.files.end())
                << entry.path();
    }
}

/// Keys that are also ordinary words: literals prove nothing, and only comparisons count.
const std::set<std::string> kOtherWords = {
    "artefacts",   // a field of reports
    "constant",    // a bias setting, and a term of the account
    "hard",        // the reference of a light without size
    "normals",     // a vertex attribute
    "raster",      // a term of the account
    "slope",       // a bias setting, and a term of the account
    "taps",        // a field of probes
    "truth",       // a command, an output, a pass
    "cascade",     // one of a light's maps
    "visibility",  // a view, an output, a pass
};

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Returns the places where a source compares a row's key: "file:line".
std::vector<std::string> places_with_key(const std::string& name, const std::string& text,
                                         const std::vector<Table>& all) {
    std::vector<std::string> out;
    std::istringstream in(text);
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        for (const Table& t : all) {
            if (name == t.rows + ".cpp" || name == "renderer/settings/sized_kernels.cpp") continue;
            std::string define = t.setting;
            std::ranges::replace(define, '.', '_');
            for (const std::string& key : t.keys) {
                const std::string literal = "\"" + key + "\"";
                std::string chosen = define + "_" + key;
                std::ranges::replace(chosen, '-', '_');
                const std::size_t at = line.find(chosen);
                const bool defined = at != std::string::npos &&
                                     (at + chosen.size() == line.size() || !is_word(line[at + chosen.size()]));
                const bool said = line.find(literal) != std::string::npos;
                const bool compared = said && std::regex_search(line, std::regex("\\.key\\s*[!=]=\\s*" + literal));
                // The name of a view is no row of a table.
                const bool view = name == "app/report/views.cpp" && line.find("view.key ==") != std::string::npos;
                // The reference angle of a conversion is read from the values of this overlay.
                const bool angle = name == "app/convert/measured_conversion.cpp" && key == "n-dot-l";
                if ((said && !angle && !kOtherWords.contains(key)) || (compared && !view) || defined)
                    out.push_back(name + ":" + std::to_string(number) + " knows " + key);
            }
        }
    }
    return out;
}

TEST(Recipes, TechniqueKeysStandOnlyInListedFiles) {
    const std::vector<Table> all = tables();
    std::size_t read = 0;
    for (const char* folder : {"app", "renderer", "ui", "shaders"})
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string name = fs::relative(entry.path(), kRoot).generic_string();
            ++read;
            // A profile names the rows that its engine has.
            if (name.starts_with("renderer/profiles/")) continue;
            for (const std::string& place : places_with_key(name, file_bytes(entry.path()), all))
                ADD_FAILURE() << place;
        }
    EXPECT_GT(read, 200u);
    // The search finds a planted comparison.
    EXPECT_EQ(places_with_key("renderer/a.cpp", "if (filter.key == \"hard\") return;", all).size(), 1u);
    EXPECT_EQ(places_with_key("app/a.cpp", "const char* kBest = \"pcf\";", all).size(), 1u);
    EXPECT_EQ(places_with_key("shaders/lib/a.glsl", "#if bias_kind == bias_kind_receiver_plane", all).size(), 1u);
    EXPECT_EQ(places_with_key("app/a.cpp", "json[\"visibility\"] = p.visibility;", all).size(), 0u);
    // Words that are no longer keys need no exception.
    for (const std::string& word : kOtherWords) {
        bool known = false;
        for (const Table& t : all) known |= std::ranges::find(t.keys, word) != t.keys.end();
        EXPECT_TRUE(known) << word;
    }
}

}  // namespace
}  // namespace si
