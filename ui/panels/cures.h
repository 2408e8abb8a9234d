// Facts and requests of the search for fixes: changes of settings that make wrong pixels right.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "ui/panels/tune.h"

namespace si {

struct CureTable;  // renderer/measure/cures.h

/// Request for a search.
struct CureRequest {
    std::optional<glm::ivec2> pixel;  ///< pixel to make right; none: the whole picture
};

/// State and result of the search.
struct CureSearch {
    std::optional<SearchProgress> running;  ///< none: no search is under way
    const CureTable* table = nullptr;       ///< last result; null: none
    std::optional<glm::ivec2> pixel;        ///< pixel of the last result; none: the picture
    bool current = false;                   ///< the last result is about the present settings
};

/// Requests of the table of fixes.
struct CureRequests {
    std::optional<CureRequest> find_cures;  ///< start a search
    bool cancel_cures = false;
    bool forget_cures = false;  ///< drop the last result
};

}  // namespace si
