// Pictures of the window, or of a part of it, for files.
#pragma once

#include <glm/glm.hpp>
#include <optional>

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

/// Screenshots that are due, and the places of the pictures in the window.
struct ShotState {
    std::optional<Shot> next;  ///< taken in the next frame, once the menu that requested it is closed
    ScreenRect scene_rect;     ///< scene picture in the last frame
    ScreenRect map_rect;       ///< map in the last frame
    ScreenRect drawing_rect;   ///< cross-section in the last frame
};

}  // namespace si
