// Ray-traced reference of one probed pixel.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "renderer/inspect/probe.h"
#include "renderer/reference/shadow_runs.h"

namespace si {

/// Reference (ray-traced visibility) of the probed pixel under one light, and the cause of the shadow map's error
/// there. Made by trace_fragment_reference() for the pixel diagnosis.
struct FragmentReference {
    PixelState state = PixelState::Background;
    bool lit = true;   ///< result for a light without size
    double share = 1;  ///< visible share of a light with its size (light.size)
    double noise = 0;  ///< standard error of `share`; NaN: unknown
    /// Distance from the pixel's surface to the occluder nearest the light, metres along the light's ray. Counts only
    /// occluders in the shadow map: not culled, and beyond the near plane. NaN: none.
    double gap_m = std::numeric_limits<double>::quiet_NaN();
    /// Distance as gap_m, but over all casters, also those that culling or the near plane keeps out of the map. NaN:
    /// none.
    double blocker_m = std::numeric_limits<double>::quiet_NaN();
    /// Caster nearest the light among those that shadow the pixel but are missing from the map; none: no such caster,
    /// or the pixel is lit.
    std::optional<MissingCaster> missing;
    std::string missing_path;  ///< path of the missing caster; empty: none
    CauseEvidence evidence;    ///< trials of the probe, with gaps and widths from the reference
    bool any_leak = false;     ///< light in the umbra: V > 0.02, and the kernel's reach is dark: in_umbra()
    Cause cause;               ///< cause of the error, compared with a light without size
};

/// Traces the reference (ray-traced visibility) of one probed pixel under one light and classifies the pixel's shadow
/// error. Traces a few thousand rays, in the penumbra of an area light up to some ten thousand.
/// @param scene ray-tracing hierarchy over the same triangles as the probe
/// @param light result of the probe for the light
/// @param traits object_traits() of the probed scene and settings
/// @throws Error when the probe hit no surface, or a triangle of another scene
FragmentReference trace_fragment_reference(const ReferenceScene& scene, const Probe& probe,
                                           const Probe::PerLight& light, const Settings& settings,
                                           std::span<const ObjectTraits> traits);

}  // namespace si
