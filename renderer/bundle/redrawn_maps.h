// Maps that the program draws with the views of a bundle: its own maps from the same light.
#pragma once

#include <memory>

#include "renderer/bundle/bundle.h"
#include "renderer/bundle/imported_maps.h"

namespace si {

/// Returns polygon offset and culling of the first shadow map in a bundle (an engine's frame as files). The settings
/// begin with these values when a bundle is opened. Offsets above 0 are away from the light. An unknown offset is 0,
/// unknown culling is none.
CasterRaster first_raster(const Bundle& bundle);

/// Returns shadow maps of one light that the program draws itself, with the views of imported maps (an engine's
/// images). map.resolution is the longer side in texels. Each map keeps the raster state of the imported map, except
/// polygon offset and culling that the user has changed in the settings.
/// @param maps imported maps of the light, with views
/// @param begun first_raster() of the bundle: settings that differ from it were changed by the user
std::shared_ptr<const ImportedMaps> redrawn_maps(const ImportedMaps& maps, const Settings& settings,
                                                 const CasterRaster& begun);

}  // namespace si
