// The search for what puts wrong pixels right: what it found, what its table wishes for.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "ui/panels/tune.h"

namespace si {

struct CureTable;  // renderer/measure/cures.h

/// What is to be cured: a pixel, or nothing for the whole picture.
struct CureRequest {
    std::optional<glm::ivec2> pixel;
};

/// A search for what puts wrong pixels right.
struct CureSearch {
    std::optional<SearchProgress> running;
    const CureTable* table = nullptr;  ///< that was found last
    std::optional<glm::ivec2> pixel;   ///< that it is about; none: the picture
    bool current = false;              ///< it is about the present settings
};

struct CureRequests {
    std::optional<CureRequest> find_cures;
    bool cancel_cures = false, forget_cures = false;
};

}  // namespace si
