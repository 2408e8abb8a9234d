// How much of each light's maps a frame calls for.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "renderer/frame/state.h"
#include "renderer/view/culling/needed_maps.h"

namespace si {

/// Whether something that the frame is asked for reads more of maps than look-ups of the picture do, or may.
bool reads_whole_maps(const FrameState& f);

/// Of something made of all maps, how many of their texels are left out as nothing reads them; none: none are. Once the
/// maps' passes are planned.
std::optional<PartInfo> unread_texels(const FrameState& f, std::string name);

/// What of a casting light's maps the frame reads (Saving::Views). Kept until camera, scene or maps change.
/// @param maps key of what is drawn into them
NeededMaps needed_maps_of(FrameState& f, std::size_t light, std::uint64_t maps);

}  // namespace si
