// Conversion of a table of techniques to the choices of a setting.
#pragma once

#include <span>
#include <vector>

#include "renderer/settings/param.h"

namespace si {

/// Converts the rows of a table of techniques (key, label, help) to choices of a setting, in the table's order.
template <typename Row>
std::vector<Choice> choices_of(std::span<const Row> rows) {
    std::vector<Choice> out;
    for (const Row& row : rows) out.push_back({row.key, row.label, row.help});
    return out;
}

}  // namespace si
