// Facts and requests of the search for fixes: changes of settings that make wrong pixels right.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "ui/panels/tune.h"

namespace si {

struct FixTable;

/// Request for a search for fixes of wrong pixels.
struct FixRequest {
    std::optional<glm::ivec2> pixel;  ///< pixel to make right; none: the whole picture
};

/// State and result of the search for fixes.
struct FixSearch {
    std::optional<SearchProgress> running;  ///< none: no search is under way
    const FixTable* table = nullptr;        ///< last result; null: none
    std::optional<glm::ivec2> pixel;        ///< pixel of the last result; none: the picture
    bool current = false;                   ///< the last result is about the present settings
};

/// Requests of the table of fixes.
struct FixRequests {
    std::optional<FixRequest> find_fixes;  ///< start a search
    bool cancel_fixes = false;
    bool forget_fixes = false;  ///< drop the last result
};

}  // namespace si
