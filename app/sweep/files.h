// The files of a sweep's folder beside its journal.
#pragma once

#include <filesystem>

#include "app/sweep/results.h"

namespace si {

enum class SweepFiles {
    Results,    ///< results.json and results.csv
    AndReport,  ///< those, base.json and report.html
};

/// Writes them, each as a whole. Returns the results. @throws Error
SweepResults write_sweep_files(const std::filesystem::path& folder, const SweepState& state, const SweepPlan& plan,
                               SweepFiles which = SweepFiles::AndReport);

/// @throws Error where what has its name is none
void make_picture_folder(const std::filesystem::path& folder);

/// Copies the pictures of another folder's cases that this one lacks. @throws Error
void copy_pictures(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes what a sweep left in the folder, and nothing else. @throws Error while another process is at it, and as
/// require_sweep_folder() does
void forget_sweep(const std::filesystem::path& folder);

/// @throws Error when the folder holds files that a sweep would replace, and no journal that says a sweep wrote them.
void require_sweep_folder(const std::filesystem::path& folder);

/// Whether a picture of the case is not in the folder.
bool lacks_pictures(const std::filesystem::path& folder, std::size_t case_number);

/// The frontier as lines of text: cost, error and settings.
std::string frontier_text(const SweepResults& results);

}  // namespace si
