// The panel Numbers: faulty values (NaN, infinite, out of range) of the frame, and the process's memory.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/base/held_memory.h"
#include "renderer/frame/numeric_health.h"

namespace si {

struct FrameResult;
struct Settings;

/// Data that the panel Numbers shows: invalid numbers found in the frame, and memory of the process.
struct HealthFacts {
    const NumericHealth* health = nullptr;  ///< invalid numbers of the shown frame; null: not searched yet
    const MemoryReport* memory = nullptr;   ///< memory of the process; null: not sampled yet
};

/// Texel of a shadow map that the map viewer outlines.
struct MarkedTexel {
    int light = 0;
    int view = 0;         ///< index of the light's view (cube face, cascade)
    glm::ivec2 texel{0};  ///< from the lower left
    int level = 0;        ///< mip level
    bool operator==(const MarkedTexel&) const = default;
};

/// Requests of the panel Numbers to the application: search the frame for invalid numbers, sample the memory, and show
/// a pixel or texel that was found.
struct HealthRequests {
    bool want_health = false;               ///< search the frame, while the panel is shown
    bool want_memory = false;               ///< sample the memory, while the panel is shown
    std::optional<glm::ivec2> probe_pixel;  ///< probe this pixel of the scene picture
    std::optional<MarkedTexel> show_texel;  ///< outline this texel and bring it to the middle of the map viewer
    bool search_all = false;                ///< search every frame, whatever is shown
};

/// Draws the panel Numbers: invalid numbers (NaN, infinite, out of range) found in the frame, and the process's memory.
/// @param settings changed by a click that shows another map @param marked the texel that the map viewer outlines
/// @param result the last frame; null: none
void draw_health(Settings& settings, const std::optional<MarkedTexel>& marked, const FrameResult* result,
                 const HealthFacts& facts, HealthRequests& requests);

}  // namespace si
