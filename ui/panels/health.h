// What the panel of the frame's numbers is told, wishes for and marks.
#pragma once

#include <glm/glm.hpp>

#include "renderer/base/held.h"
#include "renderer/frame/numeric_health.h"

namespace si {

struct HealthFacts {
    const NumericHealth* health = nullptr;  ///< of the frame shown; null: not asked for, or not there yet
    const MemoryFacts* memory = nullptr;    ///< of the process; null: not asked for, or not there yet
};

struct HealthRequests {
    bool want_health = false;  ///< the panel is shown: the frame's numbers are searched
    bool want_memory = false;  ///< the panel is shown: memory and its holders are asked for
    bool search_all = false;   ///< no picture is left out, whatever is shown
};

/// A texel that the map viewer outlines, from the lower left.
struct MarkedTexel {
    int light = 0, view = 0;
    glm::ivec2 texel{0};
    int level = 0;  ///< mip level that it is of
    bool operator==(const MarkedTexel&) const = default;
};

}  // namespace si
