// The way of light to the probed pixel, as the shadow test sees it.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/inspect/probe.h"

namespace si {

struct ProbeRay {
    glm::dvec3 from{0};      ///< world; the light, or for parallel rays a point of the near plane
    glm::dvec3 occluder{0};  ///< at the stored depth of the texel; `to` when nothing is stored before the surface
    glm::dvec3 to{0};        ///< the surface
    bool blocked = false;    ///< the stored depth keeps light from the surface
};

/// Nothing when the light has no map or the surface lies behind it.
std::optional<ProbeRay> probe_ray(const Probe& probe, const Probe::PerLight& light, const FittedLight& fitted);

}  // namespace si
