// The search for what puts wrong pixels right: what it found, what its table wishes for.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "ui/panels/tune.h"

namespace si {

struct CureTable;  // renderer/advise/fixes.h

/// What is to be cured: a pixel, or nothing for the whole picture.
struct CureWish {
    std::optional<glm::ivec2> pixel;
};

/// A search for what puts wrong pixels right.
struct CureSearch {
    std::optional<TuneFacts> running;
    const CureTable* table = nullptr;  ///< that was found last
    std::optional<glm::ivec2> pixel;   ///< that it is about; none: the picture
    bool current = false;              ///< it is about the present settings
};

struct CureActions {
    std::optional<CureWish> find_cures;
    bool cancel_cures = false, forget_cures = false;
};

}  // namespace si
