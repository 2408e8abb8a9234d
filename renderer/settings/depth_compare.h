// Depth comparison of a look-up with the map's texels, which kernel, bias and map settings decide together.
#pragma once

#include "renderer/settings/filters.h"
#include "renderer/settings/settings.h"

namespace si {

/// Returns true when every texel that the kernel fetches is compared with a depth of its own, that of the receiver's
/// plane at the texel. Conditions: the chosen bias computes such depths (Bias::per_texel), and the kernel compares
/// depths.
bool compares_per_texel(const Settings& settings);
/// Returns true when the texture unit compares the depths through a shadow sampler (sampler2DShadow), instead of the
/// shader. Conditions: filter.method requests it, the map has a depth format and no pages, and a bilinear kernel
/// compares all texels with one depth.
bool uses_sampler(const Settings& settings);

/// Returns the texture calls and fetched texels of the chosen kernel for one light and one lit pixel. They depend on
/// the comparison method in use (gathers or shadow sampler).
FilterCost kernel_cost(const Settings& settings);

}  // namespace si
