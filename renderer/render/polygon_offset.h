// Measurement of glPolygonOffset, whose steps OpenGL leaves to the driver.
#pragma once

#include "renderer/gl/raster_traits.h"

#include "renderer/settings/settings.h"

namespace si {

/// Draws planes into a small map of the format (a MapFormat) with and without an offset and reads the differences back:
/// flat ones at several depths for r, tilted ones in several directions for m. Of what differs by depth or direction
/// the least counts, and of each reading one step less. Leaves the OpenGL state as it was. Needs a current context.
PolygonOffset measure_polygon_offset(MapFormat format);

}  // namespace si
