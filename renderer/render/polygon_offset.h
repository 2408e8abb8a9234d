// Measurement of glPolygonOffset, whose steps OpenGL leaves to the driver.
#pragma once

#include "renderer/gl/raster_traits.h"
#include "renderer/settings/settings.h"

namespace si {

/// Measures the driver's polygon offset units (r) and slope factor (m) for maps of one format. Planes with and without
/// offset are drawn into a small map and read back: flat ones for r, tilted ones for m. Returns the smallest result,
/// less one step of the format. Needs a current context; restores the OpenGL state.
PolygonOffset measure_polygon_offset(MapFormat format);

}  // namespace si
