// Depth comparison of a look-up with the map's texels, which kernel, bias and map settings decide together.
#pragma once

#include "renderer/settings/filters.h"
#include "renderer/settings/settings.h"

namespace si {

/// Returns true when each texel of a look-up is compared with its own depth: the bias row is per texel, and the kernel
/// compares depths.
bool compares_per_texel(const Settings& settings);
/// Returns true when the kernel compares through a shadow sampler (sampler2DShadow). Conditions: filter.method requests
/// it, the map has a depth format and no pages, and a bilinear kernel compares all texels with one depth.
bool uses_sampler(const Settings& settings);

/// Returns the cost per pixel of the chosen kernel in texture fetches, by the comparison method in use (gathers or
/// shadow sampler).
FilterCost cost_of(const Settings& settings);

}  // namespace si
