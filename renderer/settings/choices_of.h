// The choices of a setting that names a row of a table of techniques.
#pragma once

#include <span>
#include <vector>

#include "renderer/settings/param.h"

namespace si {

/// One choice a row, by its key, label and help, in the table's order.
template <typename Row>
std::vector<Choice> choices_of(std::span<const Row> rows) {
    std::vector<Choice> out;
    for (const Row& row : rows) out.push_back({row.key, row.label, row.help});
    return out;
}

}  // namespace si
