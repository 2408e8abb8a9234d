// Paging of shadow maps (map.virtual): whether maps are drawn by pages under the other settings, and the page size.
#pragma once

#include <string_view>

#include "renderer/settings/settings.h"

namespace si {

/// Returns the reason, as a text for panels, why map.virtual (maps drawn by pages) has no effect; empty if it has an
/// effect. Kernels that read moments exclude pages, and so does map.blur_texels, since they process whole maps.
/// @param light not used
std::string_view paging_idle_reason(const Settings& settings, int light);

/// Returns true when shadow maps are drawn by pages: map.virtual is on and has an effect. Only the pages that pixels
/// read are drawn.
bool draws_pages(const Settings& settings);

/// Returns true when light number `light` has clip levels instead of the maps whose region light.fit chooses. Clip
/// levels are virtual maps around the camera, each with larger texels than the one before.
bool has_clip_levels(const Settings& settings, int light);

/// Returns the side of a page of a virtual map in texels: map.page_size rounded down to a power of two, at most an
/// eighth of map.resolution.
int page_texels(const Settings& settings);

}  // namespace si
