// State of the scene picture's panel: what is under the mouse, and the gesture that is under way.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "renderer/settings/settings.h"
#include "ui/scene_view/cameras.h"
#include "ui/scene_view/light_drag.h"
#include "ui/scene_view/picture_view.h"

namespace si {

/// State of the panel with the scene picture: marks and pixel under the mouse, and gestures under way.
struct ScenePanel {
    glm::ivec2 wanted_size{0};                ///< size in pixels of the picture that was requested last
    float covered = 0;                        ///< height at the picture's lower edge that the open strip covers, pixels
    std::optional<PictureView> view;          ///< placement of the picture in the last frame; none: it was not drawn
    std::optional<glm::ivec2> hovered_pixel;  ///< pixel under the mouse, row 0 at the top
    std::optional<LightHit> hovered_light;    ///< mark or handle of a light under the mouse
    bool lights_listed = false;               ///< the list of lights was visible in the last frame
    char hovered_axis = 0;                    ///< 'x', 'y', 'z': gnomon axis whose end is under the mouse; 0: none
    std::string menu_object;                  ///< node path that the context menu is about; empty: the background

    bool dragging = false;                  ///< a drag in a picture is under way
    bool press_moved = false;               ///< the press in the picture has become a drag
    bool press_taken = false;               ///< the press is on a light, the gnomon or a dividing line; no camera moves
    std::optional<HandleDrag> handle_drag;  ///< drag of a light's handle that is under way
    double wheel_until = 0;                 ///< ImGui time until which turns of the wheel are one gesture, seconds
    bool select_probed = false;             ///< the next probe selects its object (a double click)

    Flight flight;
    bool camera_flew = false;  ///< the camera moved, or a key was down, while the right button was held
    std::optional<CameraSettings> camera_before_light;  ///< camera to return to from the light's view
};

}  // namespace si
