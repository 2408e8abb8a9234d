// Settings that describe a given camera.
#pragma once

#include "renderer/settings/settings.h"
#include "renderer/view/cameras/make_camera.h"

namespace si {

/// Manual settings under which make_camera() gives this camera again; near and far planes are left to the fit.
CameraSettings camera_settings(const Camera& camera);

}  // namespace si
