// The recipes of docs/architecture.md name files that exist, and all that a technique takes: nothing else in the
// program knows a row by its key.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/overlays.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SI_SOURCE_DIR;

std::string whole_text(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

/// A table of techniques: its row file, the folder of its GLSL files, and the rows' keys.
struct Table {
    std::string rows, folder, setting;
    std::vector<std::string> keys, files;
};

template <typename Row>
Table table(std::string rows, std::string folder, std::string setting, std::span<const Row> list) {
    Table t{std::move(rows), std::move(folder), std::move(setting), {}, {}};
    for (const Row& row : list) {
        t.keys.emplace_back(row.key);
        if constexpr (requires { row.file; }) t.files.emplace_back(row.file);
    }
    return t;
}

std::vector<Table> tables() {
    return {table("renderer/settings/filters", "shaders/filters", "filter.kernel", filters()),
            table("renderer/settings/biases", "shaders/biases", "bias.kind", biases()),
            table("renderer/settings/overlays", "shaders/overlays", "view.overlay", overlays())};
}

/// Headline and text of each recipe.
std::map<std::string, std::string> recipes() {
    const std::string all = whole_text(kRoot / "docs/architecture.md");
    const std::size_t from = all.find("\n## Recipes"), end = all.find("\n## ", from + 1);
    EXPECT_NE(from, std::string::npos);
    std::istringstream in(all.substr(from, end - from));
    std::map<std::string, std::string> out;
    std::string title;
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("### "))
            title = line.substr(4);
        else if (!title.empty())
            out[title] += line + "\n";
    return out;
}

/// What of a recipe's `code` is a file of the tree: it has a folder, or an ending of ours.
std::vector<std::string> files_named(const std::string& recipe) {
    static const std::regex code("`([^`\n]+)`"), file("([A-Za-z0-9_*-]+/)*[A-Za-z0-9_.*-]+\\.(cpp|h|glsl|md|json|sh)");
    std::vector<std::string> out;
    for (std::sregex_iterator at(recipe.begin(), recipe.end(), code), end; at != end; ++at) {
        const std::string text = (*at)[1];
        for (std::sregex_iterator f(text.begin(), text.end(), file), none; f != none; ++f) out.push_back(f->str());
    }
    return out;
}

/// Whether some file of the tree has that path, from its root or from shaders/; NAME and * stand for any word, and a
/// bare name for that of any folder.
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
            EXPECT_TRUE(exists(file)) << "\"" << title << "\" names " << file;
            ++named;
        }
    EXPECT_GT(all.size(), 5u);
    EXPECT_GT(named, 15u);
    EXPECT_FALSE(exists("shaders/filters/NAME.txt.glsl"));
    EXPECT_FALSE(exists("renderer/settings/sundials.cpp"));
}

TEST(Recipes, SayWhereTheRowsAndFilesOfEachTableStand) {
    std::string text;
    for (const auto& [title, recipe] : recipes()) text += recipe;
    for (const Table& t : tables()) {
        EXPECT_NE(text.find(t.rows + ".cpp"), std::string::npos) << t.rows;
        EXPECT_NE(text.find(t.folder + "/NAME.glsl"), std::string::npos) << t.folder;
        for (const std::string& file : t.files) {
            EXPECT_TRUE(fs::exists(kRoot / "shaders" / file)) << file;
            EXPECT_EQ(fs::path("shaders" / fs::path(file)).parent_path(), t.folder) << file;
        }
        // A file that no row names is a technique that nobody can choose.
        for (const auto& entry : fs::directory_iterator(kRoot / t.folder))
            EXPECT_NE(std::ranges::find(t.files, fs::relative(entry.path(), kRoot / "shaders").generic_string()),
                      t.files.end())
                << entry.path();
    }
}

/// Keys that are words for other things as well: there a literal says nothing, and only comparisons count.
const std::set<std::string> kOtherWords = {
    "artefacts",   // a field of reports
    "constant",    // a bias setting, and a term of the account
    "hard",        // the truth of a light without size
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

/// Where a source knows a row by its key: "file:line".
std::vector<std::string> places_that_know(const std::string& name, const std::string& text,
                                          const std::vector<Table>& all) {
    std::vector<std::string> out;
    std::istringstream in(text);
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        for (const Table& t : all) {
            if (name == t.rows + ".cpp" || name == "renderer/settings/aliases.cpp") continue;  // what other names mean
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
                // What a view of that name is asked for is no row of a table.
                const bool view = name == "app/report/views.cpp" && line.find("view.key ==") != std::string::npos;
                if ((said && !kOtherWords.contains(key)) || (compared && !view) || defined)
                    out.push_back(name + ":" + std::to_string(number) + " knows " + key);
            }
        }
    }
    return out;
}

TEST(Recipes, NothingElseKnowsATechniqueByItsKey) {
    const std::vector<Table> all = tables();
    std::size_t read = 0;
    for (const char* folder : {"app", "renderer", "ui", "shaders"})
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string name = fs::relative(entry.path(), kRoot).generic_string();
            ++read;
            for (const std::string& place : places_that_know(name, whole_text(entry.path()), all))
                ADD_FAILURE() << place;
        }
    EXPECT_GT(read, 200u);
    // The search finds what it is for.
    EXPECT_EQ(places_that_know("renderer/a.cpp", "if (filter.key == \"hard\") return;", all).size(), 1u);
    EXPECT_EQ(places_that_know("app/a.cpp", "const char* kBest = \"pcf\";", all).size(), 1u);
    EXPECT_EQ(places_that_know("shaders/lib/a.glsl", "#if bias_kind == bias_kind_receiver_plane", all).size(), 1u);
    EXPECT_EQ(places_that_know("app/a.cpp", "json[\"visibility\"] = p.visibility;", all).size(), 0u);
    // Words that are no keys any more need no exception.
    for (const std::string& word : kOtherWords) {
        bool known = false;
        for (const Table& t : all) known |= std::ranges::find(t.keys, word) != t.keys.end();
        EXPECT_TRUE(known) << word;
    }
}

}  // namespace
}  // namespace si
