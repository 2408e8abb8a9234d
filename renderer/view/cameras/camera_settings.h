// Settings that describe a given camera.
#pragma once

#include "renderer/projection/camera.h"
#include "renderer/settings/settings.h"

namespace si {

/// Manual settings under which make_camera() gives this camera again; near and far planes are left to the fit.
CameraSettings camera_settings(const Camera& camera);

}  // namespace si
