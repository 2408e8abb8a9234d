// Table of fits, which choose the region of a shadow map. A new fit is one row of this table and one function.
#pragma once

#include <span>
#include <string_view>

#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

/// Row of the table of fits: one rule that chooses the region of the scene that a shadow map covers (light.fit).
struct FitRow {
    std::string_view key, label, help;
    std::string_view paper;     ///< source; empty: common knowledge
    bool reads_camera = false;  ///< maps change with the camera
    bool warps = false;         ///< maps of directional lights are warped by a perspective projection (LiSPSM)
    bool narrows = false;       ///< a map may leave out regions without shadow
};

/// Returns the table of fits, the rules that choose the region of a shadow map, in the order of the enumeration
/// LightFit.
std::span<const FitRow> fits();
/// Returns the table row of a fit, the rule that chooses the region of a shadow map. For a number outside the
/// enumeration it returns the row of LightFit::Scene.
const FitRow& fit_row(LightFit fit);

/// Returns true when light.near and light.far give the depth range of the light's maps, instead of the fit (light.fit,
/// the rule that chooses a map's region).
constexpr bool uses_manual_near_far(const LightSettings& light) {
    return light.near_far == NearFar::Manual || (light.near_far == NearFar::Fitted && light.fit == LightFit::Manual);
}

/// Returns true when each map of the light is fitted to a depth slice of the view frustum. Such a light is directional
/// and has several cascades, or one map that is stabilised or warped.
bool uses_camera_slices(const LightSettings& settings);

/// Returns true when the maps of light number `light` are fitted again whenever the camera moves.
bool fit_reads_camera(const Settings& settings, int light);
/// Returns true when the fit of light number `light` (the rule that chooses the region of its maps) uses depths
/// measured in the camera's depth buffer (sample distribution shadow maps).
bool fit_reads_measured_depths(const Settings& settings, int light);

}  // namespace si
