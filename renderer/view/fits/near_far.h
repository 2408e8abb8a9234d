// Near and far planes of shadow maps, as light.near_far chooses them. Inside of view/ only.
#pragma once

#include "renderer/projection/depth_span.h"
#include "renderer/view/fits/fit_context.h"

namespace si {

/// Sets near and far planes of a parallel view whose width is set.
/// @param found the depth range along the axis that the fit needs, metres
/// @param receivers depth range of the receivers; null: all receivers between the map's sides
void set_parallel_range(LightView& view, const FitContext& c, DepthSpan found, const DepthSpan* receivers = nullptr);

/// Returns the distance in metres that the near plane of a pancaked map needs in front of the nearest receiver, for the
/// bias and the kernel of the settings. Casters clamped to the near plane then stay in front of every compared depth.
/// @param texel_m width of a texel
/// @param range_m depth range without the margin
double near_margin_for_bias_m(const FitContext& c, double texel_m, double range_m);

/// Returns the distance in metres by which the far plane moves back on a ground under a model, since kernels read
/// around the end of a shadow there. Returns 0 without a ground.
/// @param texel_m width of a texel across the rays
double ground_kernel_depth_m(const LightView& view, const FitContext& c, double texel_m);

/// Sets near and far planes of a perspective view whose width is set, from the boxes inside its pyramid and the range
/// of the light.
void set_perspective_range(LightView& view, const FitContext& c);

/// Returns the largest distance in texels between a surface's place in the map and a texel that its look-up reads:
/// kernel reach, normal offset, depth blur, and half a texel at each end.
double lookup_reach_texels(const Settings& settings);

}  // namespace si
