// The table of what a frame leaves out or keeps without changing a byte of its picture. Each can be forced: two ways,
// one picture.
#pragma once

#include <span>
#include <string_view>

#include "renderer/frame/optimisation_set.h"

namespace si {

struct OptimisationRow {
    std::string_view key, label;
    std::string_view help;  ///< what is left out, when, and why the picture cannot change; a sentence
};

std::span<const OptimisationRow> savings();
const OptimisationRow& row_of(Optimisation saving);
/// @throws Error naming the known keys
Optimisation parse_optimisation(std::string_view key);

}  // namespace si
