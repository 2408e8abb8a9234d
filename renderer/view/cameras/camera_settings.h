// Conversion of a camera to camera settings.
#pragma once

#include "renderer/projection/camera.h"
#include "renderer/settings/settings.h"

namespace si {

/// Returns manual camera settings for which make_camera() reproduces a camera. Near and far planes stay automatic.
CameraSettings camera_settings(const Camera& camera);

}  // namespace si
