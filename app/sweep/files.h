// Result files in a sweep's folder, written from its journal.
#pragma once

#include <filesystem>
#include <vector>

#include "app/sweep/results.h"

namespace si {

/// Set of result files of a sweep to write.
enum class SweepFiles {
    Results,    ///< results.json and results.csv
    AndReport,  ///< those, and base.json and report.html
};

/// Writes the result files of a sweep, each atomically. @returns the results @throws Error
SweepResults write_sweep_files(const std::filesystem::path& folder, const SweepState& state, const SweepPlan& plan,
                               SweepFiles which = SweepFiles::AndReport);

/// Makes the folder of a sweep's pictures. @throws Error when a file has its name
void make_picture_folder(const std::filesystem::path& folder);

/// Copies pictures of a sweep's cases that the target folder lacks. @param from, to folders of sweeps @throws Error
void copy_pictures(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes the files that a sweep wrote into its folder, and no other files. @throws Error while another process writes
/// there, or when the folder holds no sweep (require_sweep_folder())
void remove_sweep_files(const std::filesystem::path& folder);

/// Checks that a sweep may write into the folder. @throws Error when the folder holds files that a sweep would replace
/// and no journal of a sweep
void require_sweep_folder(const std::filesystem::path& folder);

/// Returns the files that a sweep writes into the folder, with the pictures that are there.
std::vector<std::filesystem::path> sweep_files(const std::filesystem::path& folder);

/// Returns true if a picture of the case is missing in the folder.
bool lacks_pictures(const std::filesystem::path& folder, std::size_t case_number);

/// Formats the Pareto front of a sweep as lines of cost, error and settings, for the terminal.
std::string frontier_text(const SweepResults& results);

}  // namespace si
