// Tests of cross-sections on the command line: the drawings of docs/accuracy.md match their commands, and errors leave
// no partial file.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/support/process.h"
#include "tests/support/strict_xml.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

const fs::path kDocs = fs::path(SI_SOURCE_DIR) / "docs";

/// Returns the commands of the page that draw sections, without the program's name.
std::vector<Words> documented() {
    std::istringstream page(file_bytes(kDocs / "accuracy.md"));
    std::vector<Words> out;
    for (std::string line; std::getline(page, line);) {
        const Words w = line;
        if (w.size() > 3 && w[0] == "./run.sh" && w[1] == "probe") out.emplace_back(w.begin() + 1, w.end());
    }
    return out;
}

/// Expects equal drawings. Numbers are compared apart from words, since drivers may round the last digits of a depth
/// differently.
void expect_same_drawing(const std::string& a, const std::string& b, const std::string& name) {
    static const std::regex number("-?[0-9]+(\\.[0-9]+)?");
    EXPECT_EQ(std::regex_replace(a, number, "#"), std::regex_replace(b, number, "#")) << name;
    std::sregex_iterator x(a.begin(), a.end(), number), y(b.begin(), b.end(), number), end;
    for (; x != end && y != end; ++x, ++y) EXPECT_NEAR(std::stod(x->str()), std::stod(y->str()), 0.6) << name;
}

SI_TEST_IS(Later, SectionCommand, DrawingsOfThePageMatchTheirCommands);
TEST(SectionCommand, DrawingsOfThePageMatchTheirCommands) {
    const auto commands = documented();
    ASSERT_GE(commands.size(), 5u);
    for (Words command : commands) {
        const auto option = std::find(command.begin(), command.end(), "-o");
        ASSERT_TRUE(option != command.end() && option + 1 != command.end());
        const fs::path committed = fs::path(SI_SOURCE_DIR) / *(option + 1);
        *(option + 1) = (fresh_test_folder() / committed.filename()).string();
        const auto r = run_program(command);
        ASSERT_EQ(r.code, 0) << r.err;
        const std::string drawn = file_bytes(*(option + 1)), kept = file_bytes(committed);
        EXPECT_EQ(test::xml_fault(kept), "") << committed;
        if (drawn != kept) expect_same_drawing(drawn, kept, committed.filename());
        // Statements of the page hold for the pixel.
        std::string artefact = committed.stem().string().substr(std::string("section-").size());
        EXPECT_NE(r.out.find("verdict: "), std::string::npos);
        const std::map<std::string, std::string> said{{"acne", "verdict: acne: needs"},
                                                      {"peter-panning", "verdict: peter-panning: bias moves it"},
                                                      {"offset", "verdict: peter-panning (normal offset)"},
                                                      {"undersampling", "verdict: caster thinner than a texel"},
                                                      {"light-bleeding", "verdict: light bleeding"}};
        ASSERT_TRUE(said.contains(artefact)) << artefact;
        EXPECT_NE(r.out.find(said.at(artefact)), std::string::npos) << artefact << "\n" << r.out;
    }
}

TEST(SectionCommand, WorksWithJsonAndRefusesWrongPixels) {
    const fs::path folder = fresh_test_folder(), file = folder / "one.svg";
    const Words scene = "probe plane --size 160x90 --set map.resolution=256 --pixel", surface = scene + "80,60";
    EXPECT_TRUE(program_json(surface + "-o one.svg", folder)["hit"].get<bool>());
    const std::string svg = file_bytes(file);
    EXPECT_EQ(test::xml_fault(svg), "");
    EXPECT_EQ(run_program(surface + "--no-truth -o one.svg", folder).code, 0);
    EXPECT_NE(file_bytes(file), svg) << "without rays it shows none";
    const std::string before = file_bytes(file);

    const auto nothing = run_program(scene + "0,0 -o one.svg", folder);
    if (nothing.out.find("nothing there") != std::string::npos) {
        EXPECT_EQ(nothing.code, 1);
        EXPECT_NE(nothing.err.find("one.svg"), std::string::npos) << nothing.err;
    }
    expect_error(surface + "-o one.png", 2, ".svg", folder);
    EXPECT_EQ(run_program(surface + "-o none/one.svg", folder).code, 1);
    EXPECT_EQ(file_bytes(file), before);
}

}  // namespace
}  // namespace si
