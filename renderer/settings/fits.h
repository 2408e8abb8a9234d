// The table of fits: what a shadow map covers. A new one is one row here and one function.
#pragma once

#include <span>
#include <string_view>

#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

struct FitRow {
    std::string_view key, label, help;
    std::string_view paper;     ///< where it is from; empty: it is common
    bool reads_camera = false;  ///< maps change with the camera
    bool warps = false;         ///< maps of suns get a perspective across their rays
    bool narrows = false;       ///< it may leave out of a map what is never in shadow
};

/// In the order of LightFit, whose names the program itself knows.
std::span<const FitRow> fits();
/// The row that light.fit names; for numbers that name none the whole scene.
const FitRow& fit_row(LightFit fit);
std::span<const Choice> fit_choices();

/// Whether light.near and light.far say where a light's maps begin and end.
constexpr bool uses_manual_near_far(const LightSettings& light) {
    return light.near_far == NearFar::Manual || (light.near_far == NearFar::Fitted && light.fit == LightFit::Manual);
}

/// Whether the light's maps are made for slices of what the camera sees: several, or one that is stabilised or warped.
bool uses_camera_slices(const LightSettings& settings);

/// Whether the fit that these settings choose for a light depends on the camera.
bool fit_reads_camera(const Settings& settings, int light);
/// Whether it goes by the measured depths of what the camera sees.
bool fit_reads_measured_depths(const Settings& settings, int light);

}  // namespace si
