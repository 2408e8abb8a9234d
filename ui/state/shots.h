// Screenshots of the window or of a part of it.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace si {

/// Part of the editor that a screenshot shows. Drawing: the probe's cross-section.
enum class Shot { Scene, Map, Window, Drawing };

/// Rectangle of the screen in ImGui's units, y down. The size is 0 if that part was not drawn.
struct ScreenRect {
    glm::vec2 lo{0};
    glm::vec2 size{0};
};

/// Request for a screenshot of this frame.
struct ShotRequest {
    Shot of = Shot::Window;
    ScreenRect rect;  ///< part of the window to cut out
};

/// Screenshots that are due, and the places of the pictures in the window.
struct ShotState {
    std::optional<Shot> next;  ///< taken in the next frame, once the menu that requested it is closed
    ScreenRect scene_rect;     ///< scene picture in the last frame
    ScreenRect map_rect;       ///< map in the last frame
    ScreenRect drawing_rect;   ///< cross-section in the last frame
};

}  // namespace si
