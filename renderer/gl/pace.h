// How many pictures a CPU rasteriser may have under way, and what those that are done still hold.
#pragma once

namespace si::gl {

/// Call after each picture of many, such as a layer of a map, where a CPU rasteriser draws: every eighth waits until
/// all of the thread's are done. llvmpipe (Mesa 22.3) has up to 64 under way and gives each a place that keeps the
/// images drawn into and read until the place is needed again; once it has 64 places it uses the first alone, and what
/// the others keep stays in memory for good.
void keep_few_under_way();

/// Has llvmpipe let go of the images that pictures long done still keep (see keep_few_under_way()): every place is
/// used anew, which takes some ten milliseconds. Call while nothing is asked for. Other drivers have nothing to do.
/// @return false when the machine was so busy that some places may not have been reached
bool let_go_of_done_pictures();

}  // namespace si::gl
