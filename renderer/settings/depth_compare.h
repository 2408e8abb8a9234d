// The comparison of a look-up's depth with the map's texels, as kernel, bias and map settings make it together.
#pragma once

#include "renderer/settings/filters.h"
#include "renderer/settings/settings.h"

namespace si {

/// Whether every texel is compared with a depth of its own: bias.kind would, and the kernel compares depths.
bool compares_per_texel(const Settings& settings);
/// Whether a kernel compares in a shadow sampler: where filter.method asks for it, the map's format can, and one depth
/// serves all texels of a bilinear comparison.
bool uses_sampler(const Settings& settings);

/// Cost of the kernel that the settings choose, by the method of comparison in use.
FilterCost cost_of(const Settings& settings);

}  // namespace si
