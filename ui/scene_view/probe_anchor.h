// A probe sticks to the surface that was probed, wherever a camera that moves takes it; what a loupe shows of it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "renderer/frame/frame.h"
#include "renderer/projection/camera.h"

namespace si {

struct Probe;

/// A probed point of a surface.
struct ProbeAnchor {
    glm::dvec3 position_ws{0}, normal_ws{0, 1, 0};
    std::string scene;    ///< EditorState::scene_name
    glm::ivec2 pixel{0};  ///< where it was seen last: that is the probed pixel, or another one was chosen since
};

/// Where a camera sees it.
enum class AnchorPlace {
    Seen,
    Hidden,   ///< behind another surface, which is probed in its place
    Outside,  ///< beside the picture or behind the camera: nothing is probed
};

/// The pixel of a picture of this size, row 0 at the top, that the point lies in; none where it is not in the picture.
std::optional<glm::ivec2> anchored_pixel(const ProbeAnchor& anchor, const Camera& camera, int width, int height);

/// Whether a probe of that pixel found a surface before the point.
bool hides(const Probe& probe, const ProbeAnchor& anchor);

/// Pixels of a picture as the renderer drew them.
struct LoupeFacts {
    glm::ivec2 at{0};                 ///< in the middle
    ByteImage pixels;                 ///< kLoupeReach on each side of it; what is outside of the picture has alpha 0
    std::optional<float> visibility;  ///< of the shown light; none: there is no surface
};

inline constexpr int kLoupeReach = 8;

}  // namespace si
