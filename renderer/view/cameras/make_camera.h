// The picture's camera, made from settings and scene.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Makes the picture's camera from the settings: from manual values, through the light that view.light selects, or
/// automatically. A camera through a light has the near and far planes of the light's view; its shadow map fills the
/// shorter side of the picture. The automatic camera is the scene's own, or frames the scene's bounds. It also replaces
/// a camera through a light without a shadow map.
/// @param aspect width / height of the picture
/// @param fitted_without_camera lights fitted by fit_maps() without a camera; empty: fitted here if needed
Camera make_camera(const Scene& scene, const Settings& settings, double aspect,
                   std::span<const FittedLight> fitted_without_camera = {});

/// Converts a camera to manual camera settings, from which make_camera() makes the same camera. Near and far planes
/// stay automatic.
CameraSettings camera_settings(const Camera& camera);

/// Returns the picture's camera (make_camera()) as manual camera settings, so that the user can move it. Near and far
/// planes of a camera that looks through a light are dropped, since they would cut the scene once the camera moves.
/// @param aspect width / height of the picture, on which automatic framing depends
CameraSettings manual_camera(const Scene& scene, const Settings& settings, double aspect = 16.0 / 9.0);

}  // namespace si
