#include "tests/support/stability.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>

#include "app/base/output.h"
#include "tests/support/hard_case.h"
#include "tests/support/requested_driver.h"

namespace si::test {
namespace {

constexpr const char* kPage = SI_SOURCE_DIR "/docs/lab/stability.md";
constexpr const char* kHowToUpdate = "; scripts/stability.sh writes it again";
constexpr std::string_view kIntro =
    "# Stability\n\n"
    "Results of the tests of the [hard cases](../hard-cases.md), by driver. `scripts/stability.sh` writes this page "
    "from "
    "their run.\nDo not edit it by hand.\n\n"
    "The tests compare verdicts and not digits. A test fails if a row is missing, if its limit is not the table's, or "
    "if it no longer holds.\n\n"
    "*Value* is the worst of a case's tests. *Margin* is the distance to the limit. *Found* is the least value of the "
    "same tests without the fix.\n";
constexpr std::string_view kHead =
    "| # | case | measure | limit | unit | value | margin | without the fix | found | verdict |\n"
    "|---|---|---|---|---|---|---|---|---|---|\n";

struct Found {
    std::optional<double> worst, least_fault;
};

const HardCase& row_of(int number) {
    for (const HardCase& row : hard_cases())
        if (row.number == number) return row;
    ADD_FAILURE() << "no hard case " << number;
    return hard_cases().front();
}

std::vector<std::string> split_cells(const std::string& line) {
    std::vector<std::string> cells;
    for (std::size_t from = line.find("| "); from != std::string::npos && from + 2 < line.size();) {
        const std::size_t to = line.find(" |", from + 2);
        if (to == std::string::npos) break;
        cells.push_back(line.substr(from + 2, to - from - 2));
        from = to + 1;
    }
    return cells;
}

std::string joined(const std::vector<std::string>& cells) {
    return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

/// Returns section titles with the lines below them, in the page's order.
std::vector<std::pair<std::string, std::vector<std::string>>> sections() {
    std::vector<std::pair<std::string, std::vector<std::string>>> out;
    std::ifstream in(kPage);
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("## "))
            out.push_back({line.substr(3), {}});
        else if (!out.empty())
            out.back().second.push_back(line);
    }
    return out;
}

class Results : public testing::EmptyTestEventListener {
public:
    static Results& get() {
        static Results* results = [] {
            auto* made = new Results;
            testing::UnitTest::GetInstance()->listeners().Append(made);  // the test framework owns it
            return made;
        }();
        return *results;
    }

    std::map<int, Found> found;

    void OnTestProgramEnd(const testing::UnitTest&) override {
        if (!std::getenv("SI_UPDATE_ASSETS") || found.empty() || driver_.empty()) return;
        std::map<std::string, std::string> texts;
        for (const auto& [title, lines] : sections()) {
            std::string& text = texts[title];
            for (const std::string& line : lines) text += line + "\n";
        }
        std::string table = fmt::format("\n{}\n\n{}", versions_, kHead);
        std::map<int, std::vector<std::string>> rows;
        for (StabilityRow& row : stability_rows(driver_)) rows[row.number] = std::move(row.cells);
        for (const auto& [number, f] : found) rows[number] = cells_of(row_of(number), f);
        for (const auto& [number, cells] : rows) table += joined(cells);
        texts[driver_] = table;
        std::string page(kIntro);
        for (const char* driver : kStabilityDrivers)
            if (texts.contains(driver)) {
                page += fmt::format("\n## {}\n{}", driver, texts[driver]);
                while (page.ends_with("\n\n")) page.pop_back();
            }
        write_file(kPage, page);
    }

    void know_driver() {
        if (!versions_.empty()) return;
        driver_ = stability_driver();
        versions_ = fmt::format("{}, OpenGL {}", current_driver(),
                                reinterpret_cast<const char*>(glGetString(GL_VERSION)));  // NOLINT
    }

private:
    static std::vector<std::string> cells_of(const HardCase& row, const Found& f) {
        std::vector<std::string> cells = stability_cells(row);
        const auto number = [](double v) { return fmt::format("{:.3g}", v); };
        const bool holds = f.worst && f.least_fault && *f.worst <= row.limit && *f.least_fault >= row.min_fault;
        cells.push_back(f.worst ? number(*f.worst) : "not measured");
        cells.push_back(f.worst ? number(row.limit - *f.worst) : "");
        cells.push_back(fmt::format("{}: at least {:.3g}", row.fault_measure, row.min_fault));
        cells.push_back(f.least_fault ? number(*f.least_fault) : "not shown");
        cells.push_back(holds ? "holds" : "FAILS");
        return cells;
    }

    std::string driver_, versions_;
};

void expect_document(const HardCase& row, bool holds) {
    if (std::getenv("SI_UPDATE_ASSETS")) return;
    static const std::string driver = stability_driver();
    static const std::vector<StabilityRow> rows = stability_rows(driver);
    if (driver.empty()) return;
    const auto it = std::ranges::find(rows, row.number, &StabilityRow::number);
    if (it == rows.end()) {
        ADD_FAILURE() << kPage << " has no row of hard case " << row.number << " on " << driver << kHowToUpdate;
        return;
    }
    EXPECT_EQ(it->verdict(), holds ? "holds" : "FAILS")
        << kPage << ", hard case " << row.number << " on " << driver << kHowToUpdate;
}

}  // namespace

void expect_within_limit(int number, double value) {
    hard_renderer();  // makes a context
    const HardCase& row = row_of(number);
    Results& results = Results::get();
    results.know_driver();
    std::optional<double>& worst = results.found[number].worst;
    if (!worst || !(value <= *worst)) worst = value;  // NaN counts as the worst
    EXPECT_LE(value, row.limit) << "hard case " << number << ", " << row.title << ": " << row.measure << ", in "
                                << row.unit;
    expect_document(row, value <= row.limit);
}

void expect_fault(int number, double value) {
    hard_renderer();
    const HardCase& row = row_of(number);
    Results& results = Results::get();
    results.know_driver();
    std::optional<double>& least = results.found[number].least_fault;
    if (!least || !(value >= *least)) least = value;
    EXPECT_GE(value, row.min_fault) << "hard case " << number << ", " << row.title
                                    << ", proves nothing: " << row.fault_measure;
}

std::string stability_driver() {
    const std::string renderer = current_driver();
    for (const char* driver : {"zink", "llvmpipe"})  // zink's name contains llvmpipe
        if (renderer.find(driver) != std::string::npos) return driver;
    return {};
}

std::vector<StabilityRow> stability_rows(const std::string& driver) {
    std::vector<StabilityRow> out;
    for (const auto& [title, lines] : sections()) {
        if (title != driver) continue;
        for (const std::string& line : lines) {
            std::vector<std::string> cells = split_cells(line);
            if (cells.size() < 2 || cells[0].find_first_not_of("0123456789") != std::string::npos) continue;
            out.push_back({std::stoi(cells[0]), std::move(cells)});
        }
    }
    return out;
}

std::vector<std::string> stability_cells(const HardCase& row) {
    return {std::to_string(row.number), std::string(row.title), std::string(row.measure),
            fmt::format("{:.3g}", row.limit), std::string(row.unit)};
}

}  // namespace si::test
