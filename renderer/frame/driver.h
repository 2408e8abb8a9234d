// What the current context can do.
#pragma once

#include "renderer/frame/renderer.h"
#include "renderer/gl/pass_clock.h"
#include "renderer/settings/settings.h"

namespace si {

/// @throws Error when the context is older than OpenGL 4.5, naming what it has.
DriverInfo query_driver();

/// The texture format of a map.
GLenum map_internal_format(MapFormat format);

}  // namespace si
