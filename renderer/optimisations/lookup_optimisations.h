// What look-ups in shadow maps need not do.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/state.h"

namespace si {

/// Reason why no bounds of the maps are found (Optimisation::EarlyOut) while the maps change.
inline constexpr std::string_view kBoundsWaitForMaps =
    "the maps are drawn anew: finding bounds would take longer than it spares";

/// Why look-ups of the frame do not first ask for the map's bounds about them (Optimisation::EarlyOut), in words;
/// empty: they do. Known once the passes that draw the maps are planned.
std::string why_no_bounds(const FrameState& f);

/// Which of them the frame's look-ups make.
std::vector<gl::Define> lookup_optimisation_defines(const FrameState& f);

/// How kernels go through their taps: unrolled, with their places in the code, or in loops that look-ups can leave.
/// @param asks_bounds look-ups ask for the maps' bounds before they fetch taps
void choose_taps(FrameState& f, bool asks_bounds);

/// How many cells beside a block hold texels that the kernel may read from it.
int bounds_reach_cells(const FrameState& f, const FittedLight& light);

/// Texels a side of a block. Blocks are made of cells, of which each is as many texels a side as a block has cells.
inline constexpr int kBoundsBlock = 16, kBoundsCell = 4;

}  // namespace si
