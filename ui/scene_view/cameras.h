// State of flying, of the frozen camera, and of the playing animation.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/projection/camera.h"
#include "renderer/projection/depth_span.h"
#include "renderer/settings/settings.h"

namespace si {

/// State of flying: moving the camera by keys while the right mouse button is held.
struct Flight {
    bool on = false;      ///< the right mouse button was down in the last frame
    bool moving = false;  ///< a movement key was down in the last frame
    double speed = 1;     ///< factor of the usual speed
};

/// Frozen camera: shadow maps stay fitted to it while another camera moves, which can then see them from outside.
struct FrozenCamera {
    Camera camera;
    CameraSettings settings;          ///< manual settings with this camera
    glm::ivec2 pixels{1};             ///< size of the camera's picture
    std::optional<DepthSpan> seen_m;  ///< measured depth range of its visible surfaces (FrameResult::seen_m)
};

/// Options of the playing animation.
struct Playback {
    bool playing = false;
    bool loop = true;
    double speed = 1;  ///< seconds of the animation per second of the clock
};

}  // namespace si
