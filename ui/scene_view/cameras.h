// Cameras that a person flies, freezes, and lets time run before.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/projection/camera.h"
#include "renderer/projection/depth_span.h"
#include "renderer/settings/settings.h"

namespace si {

/// Flying with the right mouse button held.
struct Flight {
    bool on = false, moving = false;  ///< the button, and a key of movement, were down in the last frame
    double speed = 1;                 ///< factor
};

/// The camera that maps are made for, and whose view of them is kept, while another one flies about.
struct FrozenCamera {
    Camera camera;
    CameraSettings settings;          ///< that make this camera
    glm::ivec2 pixels{1};             ///< of its picture
    std::optional<DepthSpan> seen_m;  ///< FrameResult::seen_m of it
};

/// How scene.time runs while it plays.
struct Playback {
    bool playing = false;
    bool loop = true;
    double speed = 1;  ///< seconds of the animation in a second
};

}  // namespace si
