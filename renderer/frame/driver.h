// Queries of the OpenGL context's abilities.
#pragma once

#include "renderer/frame/driver_info.h"
#include "renderer/gl/pass_clock.h"
#include "renderer/settings/settings.h"

namespace si {

/// Queries the current OpenGL context: version, limits, extensions and multisample counts.
/// @throws Error when the context is older than OpenGL 4.5; the message names the version found
DriverInfo query_driver();

/// Returns the OpenGL internal format of shadow map textures for a value of the setting map.format.
GLenum map_internal_format(MapFormat format);

}  // namespace si
