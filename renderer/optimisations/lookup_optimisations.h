// Optimisations of shadow map look-ups: early-out by depth bounds, and unrolled kernel taps.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/state.h"

namespace si {

/// Reason for skipping the depth bounds of the shadow maps (Optimisation::EarlyOut) while the maps change.
inline constexpr std::string_view kMapBoundsWaitReason =
    "the maps are drawn again: finding bounds would take longer than it saves";

/// Returns the reason why shadow map look-ups of the frame do not test the maps' depth bounds before they fetch taps
/// (Optimisation::EarlyOut); empty when look-ups test the bounds. Call after the passes that draw the maps are planned.
std::string map_bounds_skip_reason(const FrameState& f);

/// Returns the shader defines that switch the optimisations of shadow map look-ups on or off in a frame.
std::vector<gl::Define> lookup_optimisation_defines(const FrameState& f);

/// Adds the shader defines for the taps of the filter kernel to the frame (FrameState::defines). Taps are unrolled with
/// constant positions, or run in loops that a look-up can leave early.
/// @param tests_bounds true: look-ups test the maps' depth bounds before they fetch taps
void define_kernel_taps(FrameState& f, bool tests_bounds);

/// Returns the number of shadow map cells (kBoundsCell texels wide) that a kernel centred in a block of texels may read
/// beyond the block, under one light. The depth bounds of the block include this many cells at each side.
int kernel_reach_cells(const FrameState& f, const FittedLight& light);

/// Width in texels of a block of a shadow map, for which one pair of depth bounds is stored (Optimisation::EarlyOut).
inline constexpr int kBoundsBlock = 16;
/// Width in texels of a cell of a shadow map. Depth bounds of blocks are composed of those of cells.
inline constexpr int kBoundsCell = 4;

}  // namespace si
