// How many pictures a CPU rasteriser may have under way.
#pragma once

namespace si::gl {

/// Call after each picture of many, such as a layer of a map, where a CPU rasteriser draws: every eighth waits until
/// all of the thread's are done. llvmpipe (Mesa 22.3) has up to 64 under way, each with the images that it draws into,
/// and lets those go only when as many are under way again: a map of forty layers would stay in memory for good.
void keep_few_under_way();

}  // namespace si::gl
