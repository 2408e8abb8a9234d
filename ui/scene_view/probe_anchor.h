// Surface point that a probe follows while the camera moves, the ray of its shadow test, and the pixels of the loupe.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "renderer/frame/frame.h"
#include "renderer/inspect/probe.h"
#include "renderer/projection/camera.h"

namespace si {

/// Surface point that the probe (the test of one chosen pixel) follows while the camera moves.
struct ProbeAnchor {
    glm::dvec3 position_ws{0};
    glm::dvec3 normal_ws{0, 1, 0};
    std::string scene;    ///< EditorState::scene_name
    glm::ivec2 pixel{0};  ///< pixel of the point in the last frame; if another pixel is probed, the user chose it
};

/// Visibility, in the picture, of the surface point that the pixel probe follows while the camera moves.
enum class AnchorPlace {
    Seen,
    Hidden,   ///< behind another surface, which is probed in its place
    Outside,  ///< outside the picture or behind the camera; nothing is probed
};

/// Returns the pixel at which a picture shows the surface point that the pixel probe follows, row 0 at the top. Nothing
/// if the point is outside the picture. @param width, height size of the picture, pixels
std::optional<glm::ivec2> anchored_pixel(const ProbeAnchor& anchor, const Camera& camera, int width, int height);

/// Returns true if the surface in the probed pixel is nearer to the camera than the surface point that the pixel probe
/// follows (`anchor`), and hides this point.
bool hides(const Probe& probe, const ProbeAnchor& anchor);

/// Ray of a probed pixel's shadow test, from the light to the surface.
struct ProbeRay {
    glm::dvec3 from{0};      ///< world; the light, or for parallel rays a point of the near plane
    glm::dvec3 occluder{0};  ///< world; point at the texel's stored depth; `to` if nothing nearer is stored
    glm::dvec3 to{0};        ///< world; point of the surface
    bool blocked = false;    ///< the stored depth keeps light from the surface
};

/// Returns the ray of the shadow test from a light to the surface at the probed pixel, for drawing. Nothing if the
/// light has no map, or the surface is behind the light.
std::optional<ProbeRay> probe_ray(const Probe& probe, const Probe::PerLight& light, const FittedLight& fitted);

/// Pixels of the picture that the loupe (magnifier) of the editor enlarges.
struct LoupeFacts {
    glm::ivec2 at{0};                 ///< pixel in the middle
    ByteImage pixels;                 ///< `at` and kLoupeRadiusPixels on each side; alpha is 0 outside the picture
    std::optional<float> visibility;  ///< visibility of the shown light at `at`; none: no surface
};

/// Pixels of the loupe on each side of its middle.
inline constexpr int kLoupeRadiusPixels = 8;

}  // namespace si
