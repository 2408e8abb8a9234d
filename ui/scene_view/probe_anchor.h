// Surface point that a probe follows while the camera moves, and the pixels that the loupe shows.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "renderer/frame/frame.h"
#include "renderer/projection/camera.h"

namespace si {

struct Probe;

/// Surface point that the probe follows while the camera moves.
struct ProbeAnchor {
    glm::dvec3 position_ws{0};
    glm::dvec3 normal_ws{0, 1, 0};
    std::string scene;    ///< EditorState::scene_name
    glm::ivec2 pixel{0};  ///< pixel of the point in the last frame; another probed pixel was chosen by hand
};

/// Visibility, in the picture, of the surface point that the probe follows while the camera moves.
enum class AnchorPlace {
    Seen,
    Hidden,   ///< behind another surface, which is probed in its place
    Outside,  ///< outside the picture or behind the camera; nothing is probed
};

/// Returns the pixel of the probe's anchor in a picture of this size, row 0 at the top; nothing if the anchor is
/// outside the picture.
std::optional<glm::ivec2> anchored_pixel(const ProbeAnchor& anchor, const Camera& camera, int width, int height);

/// Returns true if the probe has hit a nearer surface than the anchor's, which hides the anchor.
bool hides(const Probe& probe, const ProbeAnchor& anchor);

/// Pixels of the renderer's picture that the loupe enlarges.
struct LoupeFacts {
    glm::ivec2 at{0};                 ///< pixel in the middle
    ByteImage pixels;                 ///< kLoupeRadiusPixels pixels on each side of it; alpha is 0 outside the picture
    std::optional<float> visibility;  ///< visibility of the shown light; none: no surface
};

/// Pixels of the loupe on each side of its middle.
inline constexpr int kLoupeRadiusPixels = 8;

}  // namespace si
