// The table of optimisations: work that a frame skips or caches without changing a byte of its picture. Each can be
// switched off, and the picture stays the same.
#pragma once

#include <span>
#include <string_view>

#include "renderer/frame/optimisation_set.h"

namespace si {

/// Row of the table of optimisations (work that a frame skips without changing its picture): key, label and help.
struct OptimisationRow {
    std::string_view key;    ///< name in commands and JSON
    std::string_view label;  ///< name in the editor
    std::string_view help;   ///< one paragraph: work skipped, condition, and proof of safety
};

/// Returns all rows of the table of optimisations, in the order of Optimisation.
std::span<const OptimisationRow> optimisation_rows();
/// Returns the row of an optimisation in the table of optimisations: key, label and help.
const OptimisationRow& row_of(Optimisation optimisation);

}  // namespace si
