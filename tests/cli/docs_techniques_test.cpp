// Tests of `docs techniques --only`: a redrawn row equals the row of the page, and all others stay.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "app/base/output.h"
#include "app/commands/commands.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/sources.h"
#include "tests/support/golden.h"
#include "tests/support/process.h"
#include "tests/support/source_tree.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Copies docs/techniques.md and its pictures to a fresh folder.
fs::path copied_page() {
    const fs::path folder = fresh_test_folder(), docs = test::source_tree() / "docs";
    fs::copy_file(docs / "techniques.md", folder / "techniques.md");
    fs::copy(docs / "techniques", folder / "techniques");
    return folder;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

/// Returns the text of a row's line before its figures, and the figures.
std::pair<std::string, std::vector<double>> parts_of(const std::string& line) {
    static const std::regex figures(R"(^(.*)\| ([0-9.]+) \| ([0-9.]+) % \| ([0-9.]+) \| ([0-9.]+) MiB \|$)");
    std::smatch m;
    EXPECT_TRUE(std::regex_match(line, m, figures)) << line;
    if (m.empty()) return {};
    return {m[1], {std::stod(m[2]), std::stod(m[3]), std::stod(m[4]), std::stod(m[5])}};
}

SI_TEST_IS(Later, DocsTechniques, RedrawnRowEqualsTheRowOfThePage);
TEST(DocsTechniques, RedrawnRowEqualsTheRowOfThePage) {
    if (run_program("info").out.find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "the page's pictures are llvmpipe's";
    const fs::path folder = copied_page();
    const Words arguments = "docs techniques -o techniques.md --only filter.kernel=tent3";
    const std::vector<std::string> before = lines_of(file_bytes(folder / "techniques.md"));
    const ProcessResult r = run_program(arguments, folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const std::vector<std::string> after = lines_of(file_bytes(folder / "techniques.md"));
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (before[i].find("`tent3`") == std::string::npos) {
            EXPECT_EQ(after[i], before[i]);
            continue;
        }
        // Another machine's llvmpipe may round differently.
        const auto [text, figures] = parts_of(before[i]);
        const auto [now_text, now_figures] = parts_of(after[i]);
        EXPECT_EQ(now_text, text);
        ASSERT_EQ(now_figures.size(), figures.size());
        for (std::size_t k = 0; k < figures.size(); ++k)
            EXPECT_NEAR(now_figures[k], figures[k], 0.02 * figures[k] + 1e-3) << before[i];
    }
    const fs::path drawn = folder / "techniques/filter-kernel-tent3.png";
    const ByteImage picture = test::read_golden(drawn);
    const ByteImage golden = test::read_golden(test::source_tree() / "docs/techniques/filter-kernel-tent3.png");
    ASSERT_EQ(picture.data.size(), golden.data.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < picture.data.size(); ++i)
        different += std::abs(int(picture.data[i]) - int(golden.data[i])) > 8;
    EXPECT_LT(different, picture.data.size() / 200) << drawn;
    for (const auto& entry : fs::directory_iterator(folder / "techniques"))
        if (entry.path() != drawn) {
            EXPECT_TRUE(file_bytes(entry.path()) ==
                        file_bytes(test::source_tree() / "docs/techniques" / entry.path().filename()))
                << entry.path();
        }
    // The same program and driver write the same bytes.
    const ProcessResult again = run_program(arguments + "--check", folder);
    EXPECT_EQ(again.code, 0) << again.err;
}

// Texts of the page equal those of the tables; nothing is drawn.
TEST(DocsTechniques, ShowsTheTextsOfTheTables) {
    const std::string page = file_bytes(test::source_tree() / "docs/techniques.md");
    const auto expect_text = [&](std::string_view key, std::string_view help, std::string_view paper) {
        const std::string text = fmt::format("`{}`<br>{}{} | ", key, markdown_cell(help),
                                             paper.empty() ? "" : fmt::format("<br>*{}*", markdown_cell(paper)));
        EXPECT_NE(page.find(text), std::string::npos)
            << text << "\nwrite it with: shadow-inspector docs techniques -o docs/techniques.md";
    };
    for (const std::string_view name : sweep_kernels()) {
        Settings s;
        set_setting(s, "filter.kernel", name);
        expect_text(name, filter_of(s).help, filter_of(s).paper);
    }
    for (const Bias& row : biases()) expect_text(row.key, row.help, row.paper);
    for (const Source& row : sources()) expect_text(row.key, row.help, row.paper);
    for (const FitRow& row : fits()) expect_text(row.key, row.help, row.paper);
}

TEST(DocsTechniques, RefusesUnknownRows) {
    const fs::path folder = copied_page();
    const std::string page = file_bytes(folder / "techniques.md");
    for (const auto& [row, message] : {std::pair{"filter.kernel=tent4", "did you mean filter.kernel=tent"},
                                       {"filter.kernal=tent3", "did you mean filter.kernel"},
                                       {"map.reversed_z=false", "did you mean map.reversed_z=true"},
                                       {"tent3", "the page has no rows of tent3"}})
        expect_error(Words("docs techniques -o techniques.md --only") + row, 2, message, folder);
    EXPECT_EQ(file_bytes(folder / "techniques.md"), page);
}

}  // namespace
}  // namespace si
