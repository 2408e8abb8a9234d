// Near and far planes of shadow maps, as light.near_far chooses them. Inside of view/ only.
#pragma once

#include "renderer/projection/depth_span.h"
#include "renderer/view/fits/fit_context.h"

namespace si {

/// Sets near and far planes of an orthographic light view as the setting light.near_far says. The view's width must be
/// set before.
/// @param found depth range that the fit found along the view's axis, metres
/// @param receivers depth range of the receivers; null: all receivers between the map's sides
void set_parallel_range(LightView& view, const FitContext& c, DepthSpan found, const DepthSpan* receivers = nullptr);

/// Returns the distance in metres that the near plane needs in front of the nearest receiver when casters before the
/// near plane are flattened onto it (pancaking). Such casters then stay in front of every compared depth, in spite of
/// bias and kernel.
/// @param texel_m width of a texel, metres
/// @param range_m depth range without the margin, metres
double near_margin_for_bias_m(const FitContext& c, double texel_m, double range_m);

/// Returns how far behind the end of a ground shadow the far plane of a directional light must lie, metres. A kernel
/// there also reads texels of ground that is farther from the light. Returns 0 if no ground receives shadows, or if the
/// light does not shine from above.
/// @param texel_m width of a texel across the rays, metres
double ground_kernel_depth_m(const LightView& view, const FitContext& c, double texel_m);

/// Sets near and far planes of a perspective light view as the setting light.near_far says, from the boxes inside its
/// pyramid and the range of the light. The view's width must be set before.
void set_perspective_range(LightView& view, const FitContext& c);

/// Returns the largest distance in texels between the place of a surface in a shadow map and a texel that its look-up
/// reads. It is the sum of kernel reach, normal offset, depth blur (map.blur_texels) and one texel. The texel counts as
/// half a texel around the surface's place, and half a texel around the centre of the read texel.
double lookup_reach_texels(const Settings& settings);

/// Returns lookup_reach_texels() as whole texels, at least 6. Margins of this width stay the same for most kernels, so
/// that a change of the kernel seldom draws maps again.
double whole_reach_texels(const Settings& settings);

}  // namespace si
