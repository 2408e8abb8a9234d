// Parts of each light's maps that a frame reads, cached between frames.
#pragma once

#include <string>

#include "renderer/frame/state.h"
#include "renderer/view/culling/needed_maps.h"

namespace si {

/// Returns true when the frame may read any texel of the shadow maps, and not only the texels for the picture: for an
/// overlay, a probe or the map viewer, or when the request switches Optimisation::UnreadViews off.
bool reads_whole_maps(const FrameState& f);

/// Adds a part to the report on a pass over all shadow maps: the number of texels that the pass skips, since no visible
/// surface reads them. Call after the passes that draw the maps are planned.
/// @param name name of the part in the report
/// @param[in,out] info report on the pass; unchanged if it skips no texel
void add_unread_texels_part(const FrameState& f, std::string name, PassInfo& info);

/// Returns the parts of a light's shadow maps that the frame reads, as cells of a grid over each map. Cells outside
/// these parts need not be drawn (Optimisation::UnreadViews). The result is cached until camera, scene or maps change.
/// @param light index of the light
/// @param maps cache key of the content drawn into the light's maps
NeededMaps find_needed_maps(FrameState& f, std::size_t light, std::uint64_t maps);

}  // namespace si
