#include "app/sweep/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "app/base/output.h"
#include "app/report/frontier_svg.h"
#include "app/report/report.h"
#include "app/session/presets.h"
#include "app/sweep/columns.h"
#include "app/sweep/html_report.h"
#include "app/sweep/journal.h"
#include "app/sweep/measured_cases.h"
#include "renderer/base/error.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr const char* kResultsFile = "results.json";
constexpr const char* kTableFile = "results.csv";
constexpr const char* kReportFile = "report.html";
constexpr const char* kPlotFile = "frontier.svg";
constexpr const char* kPictures = "pictures";
/// Names of the files in a sweep's folder.
constexpr std::array kNames = {kResultsFile, kTableFile, kReportFile, kPlotFile, kBasePreset, kJournalFile};

/// Returns true for file names that picture_path() and artefacts_path() make.
bool is_picture_of_case(const fs::path& path) {
    const std::string name = path.filename().string();
    const auto digits = std::min(name.find_first_not_of("0123456789"), name.size());
    return digits >= 4 && (name.substr(digits) == ".jpg" || name.substr(digits) == "-artefacts.png");
}

/// Returns the first file in the folder that a sweep would replace; empty: none.
std::string first_replaced_file(const fs::path& folder) {
    std::error_code error;
    for (const char* name : kNames)
        if (is_taken(folder / name)) return name;
    for (const auto& entry : fs::directory_iterator(folder / kPictures, error))
        if (is_picture_of_case(entry.path())) return fmt::format("{}/{}", kPictures, entry.path().filename().string());
    return {};
}

}  // namespace

SweepResults write_sweep_files(const fs::path& folder, const SweepState& state, const SweepPlan& plan,
                               SweepFiles which) {
    SweepResults results = sweep_results(state, plan);
    const Json json = results_json(results);
    write_regular_file(folder / kResultsFile, json_text(json));
    write_regular_file(folder / kTableFile, results_csv(results));
    if (which == SweepFiles::Results) return results;
    const SweepSpec spec = spec_from_json(state.spec);
    save_preset({.about = "What all cases of a sweep have in common", .scene = spec.scene, .settings = spec.base},
                folder / kBasePreset);
    const FrontierPlot plot = frontier_plot(results);
    const auto number = [&](std::size_t of) { return results.rows[of].number; };
    write_regular_file(folder / kPlotFile, frontier_svg(plot, {.number = number}));
    const std::string picture = plot.cases.empty() ? "" : frontier_svg(plot, {.in_page = true, .number = number});
    write_regular_file(folder / kReportFile, report_html(json, folder, picture));
    return results;
}

void make_picture_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder / kPictures, error);
    const std::string why = error ? error.message() : "a file";
    if (!fs::is_directory(folder / kPictures, error))
        throw Error(fmt::format("{}: is no folder for a sweep's pictures ({}); move it away, or choose another folder",
                                (folder / kPictures).string(), why));
}

void copy_pictures(const fs::path& from, const fs::path& to) {
    std::error_code error;
    make_picture_folder(to);
    for (const auto& entry : fs::directory_iterator(from / kPictures, error)) {
        if (!is_picture_of_case(entry.path())) continue;
        fs::copy_file(entry.path(), to / kPictures / entry.path().filename(), fs::copy_options::skip_existing, error);
        if (error)
            throw Error(
                fmt::format("{}: cannot be copied to {}: {}", entry.path().string(), to.string(), error.message()));
    }
}

void remove_sweep_files(const fs::path& folder) {
    require_sweep_folder(folder);
    std::error_code error;
    const fs::path journal = folder / kJournalFile;
    const int descriptor = ::open(journal.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor);
        throw Error(fmt::format("{}: another process is at this sweep; wait for it, or choose another folder",
                                folder.string()));
    }
    for (const char* name : kNames) fs::remove(folder / name, error);
    for (const auto& entry : fs::directory_iterator(folder / kPictures, error))
        if (is_picture_of_case(entry.path())) fs::remove(entry.path(), error);
    fs::remove(folder / kPictures, error);  // fails if other files are in the folder, which then stays
    if (descriptor >= 0) ::close(descriptor);
}

void require_sweep_folder(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(folder, error) && !fs::is_directory(folder, error))
        throw Error(fmt::format("{}: is a file; name a folder", folder.string()));
    for (const fs::path& file : sweep_files(folder)) require_regular(file);
    if (has_own_journal(folder)) return;
    if (const std::string name = first_replaced_file(folder); !name.empty())
        throw Error(
            fmt::format("{}: holds {}, and no {} says that a sweep wrote it; choose another folder, or move it away",
                        folder.string(), name, kJournalFile));
}

std::vector<fs::path> sweep_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const char* name : kNames) files.push_back(folder / name);
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / kPictures, error))
        if (is_picture_of_case(entry.path())) files.push_back(entry.path());
    return files;
}

bool lacks_pictures(const fs::path& folder, std::size_t case_number) {
    const auto lacks = [](const fs::path& file) {
        std::error_code error;
        const auto bytes = fs::file_size(file, error);
        return error || bytes == 0;
    };
    return lacks(folder / picture_path(case_number)) || lacks(folder / artefacts_path(case_number));
}

std::string frontier_text(const SweepResults& results) {
    const Column *x = find_column(results.x), *y = find_column(results.y);
    std::vector<const SweepRow*> on;
    for (const SweepRow& row : results.rows)
        if (std::find(results.frontier.begin(), results.frontier.end(), row.number) != results.frontier.end())
            on.push_back(&row);
    std::stable_sort(on.begin(), on.end(), [&](const SweepRow* a, const SweepRow* b) {
        return plotted_value(*x, a->numbers) < plotted_value(*x, b->numbers);
    });
    std::string text = knee_sentence(frontier_plot(results));
    if (!text.empty()) text += "\n";
    const std::string unit = x->unit == "ms" ? std::string(time_unit(results.clock)) : x->unit;
    text += fmt::format("{:>16} {:>12}  case (Pareto front)\n",
                        fmt::format("{} [{}]", label_of(*x, results.cost), unit), y->label);
    for (const SweepRow* row : on) {
        const std::string cost =
            fmt::format("{}{:.4g}", is_bound(*x, row->numbers) ? "< " : "", plotted_value(*x, row->numbers));
        text += fmt::format("{:>16} {:>12.4g} ", cost, y->value(row->numbers));
        for (const auto& [key, value] : row->settings) text += fmt::format(" {}={}", key, value);
        text += '\n';
    }
    return text;
}

}  // namespace si
