// Tests of the documents: diagrams match their sources, and links lead to files.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SI_SOURCE_DIR;

/// Returns the standard output of a shell command.
std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string out;
    std::array<char, 4096> part{};
    while (pipe) {
        const std::size_t count = std::fread(part.data(), 1, part.size(), pipe.get());
        if (count == 0) break;
        out.append(part.data(), count);
    }
    return out;
}

/// Returns the names of nodes and edges of a graphviz SVG and every line of their labels. Positions, fonts and the
/// graphviz version differ between machines and are left out.
std::multiset<std::string> labels_of(const std::string& svg) {
    static const std::regex label("<(title|text)[^>]*>([^<]*)</");
    std::multiset<std::string> out;
    for (std::sregex_iterator at(svg.begin(), svg.end(), label), end; at != end; ++at)
        out.insert((*at)[1].str() + ": " + (*at)[2].str());
    return out;
}

std::vector<fs::path> files_with(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == extension) out.push_back(entry.path());
    return out;
}

TEST(Documents, DiagramsMatchTheirSources) {
    const std::vector<fs::path> sources = files_with(kRoot / "docs/architecture", ".dot");
    EXPECT_GE(sources.size(), 3u);
    for (const fs::path& source : sources) {
        fs::path drawn = source;
        drawn.replace_extension(".svg");
        EXPECT_TRUE(fs::exists(drawn)) << drawn << ": run scripts/draw_diagrams.sh";
    }
    if (std::system("command -v dot >/dev/null 2>&1") != 0)
        GTEST_SKIP() << sources.size() << " diagrams not drawn: graphviz (dot) is not installed";
    for (const fs::path& source : sources) {
        fs::path drawn = source;
        drawn.replace_extension(".svg");
        const auto expected = labels_of(output_of("dot -Tsvg '" + source.string() + "'"));
        EXPECT_GT(expected.size(), 10u) << source << " draws nothing";
        EXPECT_EQ(labels_of(si::file_bytes(drawn)), expected) << drawn << " is old: run scripts/draw_diagrams.sh";
    }
}

// A link is written [text](path#part) with a path from its page. Other schemes and bare parts are not checked.
TEST(Documents, LinksPointToFiles) {
    static const std::regex link("\\]\\(([^)#\\s]+)(#[^)]*)?\\)"), scheme("^[a-z]+:");
    std::vector<fs::path> pages = files_with(kRoot / "docs", ".md");
    pages.push_back(kRoot / "README.md");
    std::size_t followed = 0;
    for (const fs::path& page : pages) {
        const std::string text = si::file_bytes(page);
        for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
            const std::string target = (*at)[1];
            if (std::regex_search(target, scheme)) continue;
            EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << " links to " << target;
            ++followed;
        }
    }
    EXPECT_GT(followed, 100u);
}

}  // namespace
