// Measurement of glPolygonOffset, whose steps OpenGL leaves to the driver.
#pragma once

#include "renderer/gl/raster_traits.h"
#include "renderer/settings/settings.h"

namespace si {

/// Measures how the driver computes r (least depth difference) and m (depth slope) of glPolygonOffset for shadow maps
/// of one format. Draws planes with and without polygon offset into a small map and reads them back: planes parallel to
/// the map for r, tilted ones for m. Subtracts one step of the format from each measured shift, and returns the
/// smallest r and m of all planes. Both are 0 for a format that stores distances. Needs a current context; restores the
/// OpenGL state.
PolygonOffset measure_polygon_offset(MapFormat format);

}  // namespace si
