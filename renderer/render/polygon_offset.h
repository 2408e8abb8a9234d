// Measurement of glPolygonOffset, whose steps OpenGL leaves to the driver.
#pragma once

#include "renderer/gl/raster_traits.h"
#include "renderer/settings/settings.h"

namespace si {

/// Measures the driver's polygon offset in maps of one format. Draws planes with and without an offset into a small map
/// and reads back the differences: flat planes at several depths for r, tilted ones in several directions for m. The
/// smallest result counts, less one step of the format. Needs a current context; restores the OpenGL state.
PolygonOffset measure_polygon_offset(MapFormat format);

}  // namespace si
