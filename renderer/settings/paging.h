// Paging of shadow maps (map.virtual): whether maps are drawn by pages under the other settings, and the page size.
#pragma once

#include <string_view>

#include "renderer/settings/settings.h"

namespace si {

/// Returns a text for panels that explains why map.virtual has no effect; empty if it has an effect. Kernels and blurs
/// that process whole maps exclude pages.
std::string_view paging_idle_reason(const Settings& settings, int light);

/// Returns true when shadow maps are drawn by pages (map.virtual is on and has an effect).
bool draws_pages(const Settings& settings);

/// Returns true when light number `light` has clip levels around the camera instead of the map of its fit.
bool has_clip_levels(const Settings& settings, int light);

/// Returns the side of a page in texels: map.page_size rounded down to a power of two, at most an eighth of
/// map.resolution.
int page_texels(const Settings& settings);

}  // namespace si
