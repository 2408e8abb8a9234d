// The camera as the settings and the scene make it.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// The camera that the settings ask for: by hand, through the light shown in view.light (its view, near and far planes
/// included; the map's square fills the shorter side of the picture), or (automatic) the scene's own, or one that
/// frames the bounds. Where there is no light to look through it is the automatic one.
/// @param fitted_without_camera fit_maps() of these settings' lights without a camera; fitted here when there are none
/// and one is
///     needed
Camera make_camera(const Scene& scene, const Settings& settings, double aspect,
                   std::span<const FittedLight> fitted_without_camera = {});

/// `settings` with the camera that make_camera() finds written out by hand, so that it can be moved. A light's near and
/// far planes stay behind: as the camera moves away they would cut the scene at odd places.
/// @param aspect the picture's width / height, on which the automatic framing depends
CameraSettings manual_camera(const Scene& scene, const Settings& settings, double aspect = 16.0 / 9.0);

}  // namespace si
