// Pictures of the window, or of a part of it, for files.
#pragma once

#include <glm/glm.hpp>

namespace si {

/// What a screenshot shows.
enum class Shot { Scene, Map, Window, Drawing };

/// A part of the screen in ImGui's units, y down; without a size: not drawn.
struct ScreenRect {
    glm::vec2 lo{0}, size{0};
};

struct ShotRequest {
    Shot of = Shot::Window;
    ScreenRect rect;  ///< of what is drawn in this frame
};

}  // namespace si
