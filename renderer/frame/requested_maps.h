// Maps that a request gives a light, as images or as views alone.
#pragma once

#include <cstddef>

#include "renderer/bundle/imported_maps.h"
#include "renderer/frame/frame.h"

namespace si {

/// Returns the imported maps of a light in a frame request, which have images or only views; null: none.
inline const ImportedMaps* requested_maps(const FrameRequest& request, std::size_t light) {
    return light < request.imported.size() ? request.imported[light].get() : nullptr;
}

/// Returns the raster state (such as culling and polygon offset) with which a frame request draws casters into a view
/// of a light; null: as the settings say.
inline const CasterRaster* requested_raster(const FrameRequest& request, std::size_t light, std::size_t view) {
    const ImportedMaps* maps = requested_maps(request, light);
    return maps && view < maps->raster.size() ? &maps->raster[view] : nullptr;
}

}  // namespace si
