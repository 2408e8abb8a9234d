// Result files in a sweep's folder, written from its journal.
#pragma once

#include <filesystem>

#include "app/sweep/results.h"

namespace si {

/// Set of files to write.
enum class SweepFiles {
    Results,    ///< results.json and results.csv
    AndReport,  ///< those, and base.json and report.html
};

/// Writes the result files of a sweep, each atomically. @returns the results @throws Error
SweepResults write_sweep_files(const std::filesystem::path& folder, const SweepState& state, const SweepPlan& plan,
                               SweepFiles which = SweepFiles::AndReport);

/// Makes the folder of a sweep's pictures. @throws Error when a file has its name
void make_picture_folder(const std::filesystem::path& folder);

/// Copies pictures of cases that the target folder lacks. @throws Error
void copy_pictures(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes the files of a sweep from its folder, and no others. @throws Error while another process writes there, and
/// as require_sweep_folder()
void forget_sweep(const std::filesystem::path& folder);

/// Checks that a sweep may write into the folder. @throws Error when the folder holds files that a sweep would replace
/// and no journal of a sweep
void require_sweep_folder(const std::filesystem::path& folder);

/// Returns true if a picture of the case is missing in the folder.
bool lacks_pictures(const std::filesystem::path& folder, std::size_t case_number);

/// Formats the Pareto front as lines of cost, error and settings.
std::string frontier_text(const SweepResults& results);

}  // namespace si
