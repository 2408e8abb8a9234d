// Ray from the light to the probed pixel, as the shadow test sees it.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/inspect/probe.h"

namespace si {

/// Ray of a probed pixel's shadow test, from the light to the surface.
struct ProbeRay {
    glm::dvec3 from{0};      ///< world; the light, or for parallel rays a point of the near plane
    glm::dvec3 occluder{0};  ///< world; point at the texel's stored depth; `to` if nothing nearer is stored
    glm::dvec3 to{0};        ///< world; point of the surface
    bool blocked = false;    ///< the stored depth keeps light from the surface
};

/// Returns the shadow test's ray from one light to the probed pixel; nothing if the light has no map, or the surface is
/// behind the light.
std::optional<ProbeRay> probe_ray(const Probe& probe, const Probe::PerLight& light, const FittedLight& fitted);

}  // namespace si
