// Parts of each light's maps that a frame reads, cached between frames.
#pragma once

#include <string>

#include "renderer/frame/state.h"
#include "renderer/view/culling/needed_maps.h"

namespace si {

/// Returns true when an output of the frame besides the picture may read any texel of the maps, such as an overlay, a
/// probe or the map viewer.
bool reads_whole_maps(const FrameState& f);

/// Reports texels that a pass over all maps skips because nothing reads them. Call after the maps' passes are planned.
/// @param name name of the part @param[in,out] info report on the pass; unchanged if it skips no texel
void add_unread_texels_part(const FrameState& f, std::string name, PassInfo& info);

/// Returns the cells of a casting light's maps that the frame reads (Optimisation::UnreadViews). Cached until camera,
/// scene or maps change.
/// @param light index of the light
/// @param maps key of the content drawn into its maps
NeededMaps find_needed_maps(FrameState& f, std::size_t light, std::uint64_t maps);

}  // namespace si
