// The search for what puts wrong pixels right: what it found, what its table wishes for.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "ui/panels/tune.h"

namespace si {

struct FixTable;  // renderer/advise/fixes.h

/// What is to be cured: a pixel, or nothing for the whole picture.
struct FixRequest {
    std::optional<glm::ivec2> pixel;
};

/// A search for what puts wrong pixels right.
struct FixSearch {
    std::optional<SearchProgress> running;
    const FixTable* table = nullptr;  ///< that was found last
    std::optional<glm::ivec2> pixel;  ///< that it is about; none: the picture
    bool current = false;             ///< it is about the present settings
};

struct FixRequests {
    std::optional<FixRequest> find_fixes;
    bool cancel_fixes = false, forget_fixes = false;
};

}  // namespace si
