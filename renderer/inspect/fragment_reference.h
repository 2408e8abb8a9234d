// Ray-traced reference of one probed pixel.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "renderer/inspect/probe.h"
#include "renderer/reference/shadow_runs.h"

namespace si {

/// Ray-traced visibility of one pixel under one light (the reference), and the cause of the shadow map's error at this
/// pixel.
struct FragmentReference {
    PixelState state = PixelState::Background;
    bool lit = true;   ///< result for a light without size
    double share = 1;  ///< visible share of a light with its size (light.size)
    double noise = 0;  ///< standard error of `share`; NaN: unknown
    /// Distance in metres along the light's ray to the surface nearest the light, which the map stores: with the
    /// culling of casters, beyond the near plane. NaN without an occluder.
    double gap_m = std::numeric_limits<double>::quiet_NaN();
    double blocker_m = std::numeric_limits<double>::quiet_NaN();  ///< likewise over all casters, without culling
    /// Caster nearest the light that the map does not hold; none where it holds all, or where the pixel is lit.
    std::optional<MissingCaster> missing;
    std::string missing_path;  ///< path of that caster
    CauseEvidence evidence;    ///< evidence of the probe, completed by the reference
    bool any_leak = false;     ///< V > 0.02 in the umbra at the kernel's reach: in_umbra()
    Cause cause;               ///< cause of the error, against the light without size
};

/// Traces the reference (ray-traced visibility) of one probed pixel under one light and classifies the pixel's shadow
/// error. Takes some thousand rays.
/// @param scene ray-tracing hierarchy over the same triangles as the probe
/// @param light result of the probe for the light
/// @param traits object_traits() of the probed scene and settings
/// @throws Error when the probe hit no surface, or a triangle of another scene
FragmentReference trace_fragment_reference(const ReferenceScene& scene, const Probe& probe,
                                           const Probe::PerLight& light, const Settings& settings,
                                           std::span<const ObjectTraits> traits);

}  // namespace si
