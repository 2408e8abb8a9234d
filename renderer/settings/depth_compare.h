// Depth comparison of a look-up with the map's texels, which kernel, bias and map settings decide together.
#pragma once

#include "renderer/settings/filters.h"
#include "renderer/settings/settings.h"

namespace si {

/// Returns true when each texel that the kernel fetches is compared with its own depth, that of the receiver's plane at
/// the texel. This needs a bias that computes such depths (Bias::per_texel) and a kernel that compares depths.
bool compares_per_texel(const Settings& settings);
/// Returns true when a shadow sampler (sampler2DShadow) compares the depths in place of the shader. Conditions:
/// filter.method is sampler, and the map has a depth format and no pages. A bilinear kernel must also compare all
/// texels with one depth.
bool uses_sampler(const Settings& settings);

/// Returns the texture calls and fetched texels of the chosen kernel for one light and one lit pixel. They depend on
/// the comparison method in use (gathers or shadow sampler).
FilterCost kernel_cost(const Settings& settings);

}  // namespace si
