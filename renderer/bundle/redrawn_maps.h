// Maps that the program draws with the views of a bundle: its own maps from the same light.
#pragma once

#include <memory>

#include "renderer/bundle/bundle.h"
#include "renderer/bundle/imported_maps.h"

namespace si {

/// Returns the raster state with which the settings of a bundle begin: that of its first map, with offsets above 0 away
/// from the light. Unknown offsets are 0, unknown culling is none.
CasterRaster first_raster(const Bundle& bundle);

/// Returns maps of one light that the program draws with the views of given maps. map.resolution is the longer side.
/// Each map keeps its own raster state, but for polygon offset and culling that the settings have changed.
/// @param maps has views @param begun first_raster() of the bundle
std::shared_ptr<const ImportedMaps> redrawn_maps(const ImportedMaps& maps, const Settings& settings,
                                                 const CasterRaster& begun);

}  // namespace si
