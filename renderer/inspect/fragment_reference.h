// The truth of one probed pixel: some thousand rays, once the hierarchy of a scene is there.
#pragma once

#include <limits>

#include "renderer/inspect/probe.h"
#include "renderer/reference/shadow_runs.h"

namespace si {

struct FragmentReference {
    PixelState state = PixelState::Background;
    bool lit = true;   ///< by the light as a point or a direction
    double share = 1;  ///< of the light seen when it has its size (light.size)
    double noise = 0;  ///< standard error of `share`; NaN: unknown
    /// Metres along the light's ray to the surface nearest the light, which is what the map stores, under the culling
    /// of casters and beyond the near plane; NaN where none stands before the fragment.
    double gap_m = std::numeric_limits<double>::quiet_NaN();
    double blocker_m = std::numeric_limits<double>::quiet_NaN();  ///< the same of all casters from both sides
    CauseEvidence evidence;                                       ///< of the probe, with what the truth knows filled in
    Cause cause;  ///< what is wrong with the pixel, against the light without its size
};

/// @param traits object_traits() of the scene and settings that were probed
/// @param scene of the same triangles. @throws Error when the probe hit nothing, or another scene's triangle
FragmentReference trace_fragment_reference(const ReferenceScene& scene, const Probe& probe,
                                           const Probe::PerLight& light, const Settings& settings,
                                           std::span<const ObjectTraits> traits);

}  // namespace si
