// Tests of the command report: one page whose commands reproduce its numbers, with hostile names, in a browser.
#include "app/report/preset_report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/base/json_text.h"
#include "tests/support/missing_reason.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHostile = "<img src=x onerror=alert(1)>'\"&$(touch owned)";

void write_preset(const fs::path& path, const std::string& title, const char* settings) {
    const Json json = {
        {"format", "shadow-inspector-preset"}, {"version", 3}, {"title", title}, {"settings", Json::parse(settings)}};
    std::ofstream(path) << json.dump();
}

/// Returns the commands of a page that begin with a text, with entities decoded.
std::vector<std::string> commands_of(const std::string& html, const std::string& beginning) {
    std::string pre = html.substr(html.rfind("<pre>") + 5);
    pre.resize(pre.find("</pre>"));
    for (const auto& [entity, letter] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}})
        for (std::size_t at; (at = pre.find(entity)) != pre.npos;)
            pre.replace(at, std::string_view(entity).size(), letter);
    std::vector<std::string> out;
    std::istringstream lines(pre);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(beginning)) out.push_back(line);
    return out;
}

SI_TEST_IS(Later, PresetReport, CommandsReproduceWhatThePageShows);
TEST(PresetReport, CommandsReproduceWhatThePageShows) {
    const fs::path folder = fresh_test_folder();
    write_preset(folder / "a.json", "First", R"({"filter.kernel":"hard","map.resolution":256,"camera.source":"manual",
        "camera.azimuth":20,"camera.elevation":30,"camera.distance":8})");
    write_preset(folder / "b c.json", "Second", R"({"filter.kernel":"pcf","map.resolution":512})");
    const ProcessResult r = run_program(
        Words("report boxes --preset a.json --preset") + Words{"b c.json"} + "--size 160x90 --no-time -o r.html",
        folder);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find("wrote r.html"), std::string::npos);
    const std::string html = file_bytes(folder / "r.html");
    const std::vector<std::string> measures = commands_of(html, "shadow-inspector measure");
    ASSERT_EQ(measures.size(), 2u);
    for (const std::string& command : measures) {
        const ProcessResult m =
            run_shell("$SI" + command.substr(std::string("shadow-inspector").size()) + " --json", folder);
        ASSERT_EQ(m.code, 0) << command << m.err;
        const double mae = Json::parse(m.out)["error"]["mae"].get<double>();
        EXPECT_NE(html.find(fmt::format(">{:.5f}</td>", mae)), std::string::npos) << command << ": " << mae;
    }
    EXPECT_NE(measures[1].find("--set camera.azimuth=20"), std::string::npos) << "in the view of the first preset";
    const std::vector<std::string> probes = commands_of(html, "shadow-inspector probe");
    ASSERT_FALSE(probes.empty());
    const ProcessResult p =
        run_shell("$SI" + probes.front().substr(std::string("shadow-inspector").size()) + " --json", folder);
    ASSERT_EQ(p.code, 0) << p.err;
    const Json dossier = Json::parse(p.out)["lights"][0]["dossier"];
    EXPECT_FALSE(dossier["right"].get<bool>()) << "without --pixel wrong pixels are shown";
    EXPECT_NE(html.find("data:image/svg+xml;base64,"), std::string::npos);
    const std::vector<std::string> whole = commands_of(html, "shadow-inspector report");
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_EQ(run_shell("$SI" + whole[0].substr(std::string("shadow-inspector").size()), folder).code, 0);
    EXPECT_EQ(file_bytes(folder / "r.html"), html) << "the page is reproduced byte by byte";
    EXPECT_NE(html.find("map.resolution: 256"), std::string::npos) << "differences of settings";
}

SI_TEST_IS(Later, PresetReport, FixesHoldWhenTheyAreApplied);
TEST(PresetReport, FixesHoldWhenTheyAreApplied) {
    const fs::path folder = fresh_test_folder();
    write_preset(folder / "hard.json", "", R"({"filter.kernel":"hard"})");
    const ProcessResult r =
        run_program(Words("report stage --preset acne --preset hard.json --size 160x90 --no-time -o r.html"), folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const std::string html = file_bytes(folder / "r.html");
    EXPECT_EQ(html.find("Suggested"), html.npos) << "nothing that was not drawn";
    int fixes = 0;
    const std::string beginning = "<p>Fix: set ";
    for (std::size_t at = 0; (at = html.find(beginning, at)) != html.npos; ++at, ++fixes) {
        int x = 0, y = 0;
        char key[64] = {}, value[32] = {};
        ASSERT_EQ(std::sscanf(&html[html.rfind("Pixel ", at)], "Pixel %d,%d", &x, &y), 2);
        ASSERT_EQ(std::sscanf(&html[at + beginning.size()], "%63s to %31[^ <]", key, value), 2);
        std::string amount = value;
        if (amount.ends_with('.')) amount.pop_back();
        const bool second = at > html.find("<h2>hard.json");
        const std::string command =
            fmt::format("probe stage --preset {} --size 160x90 --pixel {},{} --set {}={} --json",
                        second ? "hard.json" : "acne", x, y, key, amount);
        const Json json = program_json(command, folder);
        ASSERT_TRUE(json.is_object()) << command;
        EXPECT_TRUE(json["lights"][0]["dossier"]["right"].get<bool>()) << command;
    }
    EXPECT_GE(fixes, 1);
}

// The plot is the one of sweeps. The times of the shadows stand in the table, as multiples of one base.
SI_TEST_IS(Later, PresetReport, ShowsTheTimeOfTheShadows);
TEST(PresetReport, ShowsTheTimeOfTheShadows) {
    const fs::path folder = fresh_test_folder();
    const ProcessResult r =
        run_program(Words("report boxes --preset acne --preset tent --size 96x64 --pixel 48,40 -o r.html"), folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const std::string html = file_bytes(folder / "r.html");
    const std::size_t plot = html.find("<svg id=\"frontier-picture\"");
    ASSERT_NE(plot, html.npos);
    std::size_t cases = 0;
    for (std::size_t at = plot; (at = html.find("class=\"case\"", at)) != html.npos; ++at) ++cases;
    EXPECT_EQ(cases, 2u);
    for (const char* row : {"Time of the shadows, the light moves", "As a multiple of Hard (nearest), 1024\u00b2",
                            "Time of the shadows, the light is still"})
        EXPECT_NE(html.find(row), html.npos) << row;
}

SI_TEST_IS(Later, PresetReport, HostileNamesStayTexts);
TEST(PresetReport, HostileNamesStayTexts) {
    const fs::path folder = fresh_test_folder();
    const std::string name = std::string(kHostile) + ".json";
    write_preset(folder / name, "</title><script>alert(2)</script>\u202e", R"({"map.resolution":256})");
    write_preset(folder / "plain.json", kHostile, R"({"map.resolution":512})");
    const ProcessResult r = run_program(Words{"report", "boxes", "--preset", name, "--preset", "plain.json", "--size",
                                              "96x64", "--pixel", "48,40", "-o", "r.html"},
                                        folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const std::string html = file_bytes(folder / "r.html");
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(html.find("<img src=x"), std::string::npos);
    EXPECT_EQ(html.find("\u202e"), std::string::npos) << "marks that turn the direction of text are shown";
    EXPECT_NE(html.find("&lt;img src=x onerror=alert(1)&gt;"), std::string::npos);
    for (const char* outside : {"http:", "https:", "src=\"/", "url("})
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    // A shell that runs the page's commands runs nothing of the names.
    for (const std::string& command : commands_of(html, "shadow-inspector measure"))
        EXPECT_EQ(run_shell("$SI" + command.substr(std::string("shadow-inspector").size()), folder).code, 0) << command;
    EXPECT_FALSE(fs::exists(folder / "owned"));
    if (std::system("command -v chromium >/dev/null 2>&1") != 0) GTEST_SKIP() << test::kMissingReason << "chromium";
    const std::string at = "'" + folder.string() + "/";
    const std::string command =
        "timeout 120 chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr "
        "--v=0 --user-data-dir=" +
        at + "profile' --virtual-time-budget=4000 --dump-dom " + at + "r.html' >" + at + "dom.html' 2>" + at +
        "console.txt' </dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << file_bytes(folder / "console.txt");
    const std::string console = file_bytes(folder / "console.txt"), dom = file_bytes(folder / "dom.html");
    EXPECT_EQ(console.find("CONSOLE"), std::string::npos) << "the policy refuses a part of the page: " << console;
    EXPECT_EQ(dom.find("<img src=\"x\""), std::string::npos);
    EXPECT_NE(dom.find("<svg viewBox"), std::string::npos);
}

TEST(PresetReport, MistakesAreNamedAndWriteNothing) {
    const fs::path folder = fresh_test_folder();
    expect_error("report boxes -o r.html", 2, "--preset", folder);
    expect_error("report boxes --preset acne -o r.txt", 2, ".html", folder);
    expect_error("report boxes --preset acn -o r.html", 2, "acne", folder);
    expect_error("report boxes --preset acne --pixel 9,9 --size 8x8 -o r.html", 2, "--pixel 9,9", folder);
    write_preset(folder / "a.html", "", "{}");
    const std::string bytes = file_bytes(folder / "a.html");
    expect_error("report boxes --preset a.html -o a.html", 2, "a.html", folder);
    EXPECT_EQ(file_bytes(folder / "a.html"), bytes);
    EXPECT_FALSE(fs::exists(folder / "r.html"));
}

TEST(PresetReport, AnInterruptLeavesTheFileAsItWas) {
    const fs::path folder = fresh_test_folder();
    std::ofstream(folder / "r.html") << "mine";
    // So many rays that the report never ends by itself. One signal: a second one would end the program at once.
    const ProcessResult r = run_shell(
        "$SI report stage --preset acne --preset tent --set light.size=2 --area --set truth.samples=1048576 --set "
        "truth.noise=0 -o r.html 2>said & " +
            signal_once("grep -q acne said", "INT") + "cat said",
        folder);
    EXPECT_NE(r.out.find("code 130\n"), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("interrupted; r.html was not written"), std::string::npos) << r.out;
    EXPECT_EQ(file_bytes(folder / "r.html"), "mine");
}

}  // namespace
}  // namespace si
