// Between which depths a map stores, as light.near_far chooses. Inside of view/ only.
#pragma once

#include "renderer/projection/depth_span.h"
#include "renderer/view/fits/fit_context.h"

namespace si {

/// Sets the range of a parallel view whose width is set.
/// @param found depths of all that the fit wants in the map
/// @param receivers depths of what is looked up in it; null: all receivers between the map's sides
void set_parallel_range(LightView& view, const FitContext& c, DepthSpan found, const DepthSpan* receivers = nullptr);

/// How far before the nearest receiver the near plane of a pancaked map stands: casters that are clamped to it still
/// lie before all that is compared with them, whatever the bias.
/// @param range_m of the depths without it
double near_margin_for_bias_m(const FitContext& c, double texel_m, double range_m);

/// How much deeper than the end of a shadow on the ground under a model lies what a kernel there may read for, metres
/// along a sun's rays; 0 without such a ground.
/// @param texel_m across the rays
double ground_kernel_depth_m(const LightView& view, const FitContext& c, double texel_m);

/// Sets the range of a perspective view whose width is set, from what lies inside its pyramid and the light's range.
void set_perspective_range(LightView& view, const FitContext& c);

/// How far from where a surface lies in the map a look-up of it may lead, in texels: the kernel's reach, the normal
/// offset, what depth blur brings from aside, and half a texel of each end.
double lookup_reach_texels(const Settings& settings);

}  // namespace si
