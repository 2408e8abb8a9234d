// Whether shadow maps are drawn by pages, and how large those are: what map.virtual comes to under the other settings.
#pragma once

#include <string_view>

#include "renderer/settings/settings.h"

namespace si {

/// Why map.virtual is without effect; empty when it acts. What is made of whole maps has no pages.
std::string_view paging_idle_reason(const Settings& settings, int light);

/// Whether maps are drawn by pages.
bool draws_pages(const Settings& settings);

/// Whether a light that casts has clip levels about the camera in place of the map of its fit.
bool has_clip_levels(const Settings& settings, int light);

/// Texels along a page's side: map.page_size as a power of two, and eight of them or more to a map where that can be.
int page_texels(const Settings& settings);

}  // namespace si
