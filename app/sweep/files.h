// Result files in a sweep's folder, written from its journal.
#pragma once

#include <filesystem>
#include <vector>

#include "app/sweep/results.h"

namespace si {

/// Set of result files that write_sweep_files() writes into the folder of a sweep.
enum class SweepFiles {
    Results,    ///< results.json and results.csv
    AndReport,  ///< results.json, results.csv, base.json, frontier.svg and report.html
};

/// Computes the results of a sweep and writes its result files into its folder, each atomically. Returns the results.
/// @throws Error
SweepResults write_sweep_files(const std::filesystem::path& folder, const SweepState& state, const SweepPlan& plan,
                               SweepFiles which = SweepFiles::AndReport);

/// Makes the folder for the pictures of a sweep's cases. @param folder folder of the sweep @throws Error when a file
/// has that name
void make_picture_folder(const std::filesystem::path& folder);

/// Copies the pictures of a sweep's cases into the folder of another sweep, to merge sweeps. Pictures that exist there
/// already are kept. @param from, to folders of the sweeps @throws Error
void copy_pictures(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes the files that a sweep wrote into its folder, so that the sweep can start again. Other files stay.
/// @throws Error while another process measures into the folder, or when the files are not of a sweep
/// (require_sweep_folder())
void remove_sweep_files(const std::filesystem::path& folder);

/// Checks that a sweep may write into a folder without replacing foreign files. @throws Error when the folder contains
/// files with the names of a sweep's files, but no journal of a sweep
void require_sweep_folder(const std::filesystem::path& folder);

/// Lists the files that a sweep writes into a folder, including the pictures that are there already.
std::vector<std::filesystem::path> sweep_files(const std::filesystem::path& folder);

/// Returns true if a picture of a sweep's case is missing or empty. @param folder folder of the sweep
bool lacks_pictures(const std::filesystem::path& folder, std::size_t case_number);

/// Formats the Pareto front of a sweep (cases that no other one beats in both cost and error) as lines for the
/// terminal. They begin with a sentence on the knee of the front, after which more cost gains little.
std::string frontier_text(const SweepResults& results);

}  // namespace si
