// How many pictures a CPU rasteriser may have under way, and what those that are done still hold.
#pragma once

namespace si::gl {

/// Call after each picture of many, such as a layer of a map, where a CPU rasteriser draws: every eighth waits until
/// all of the thread's are done. llvmpipe (Mesa 22.3) has up to 64 under way and gives each a place that keeps the
/// images drawn into and read until the place is needed again; once it has 64 places it uses the first alone, and what
/// the others keep stays in memory for good.
void keep_few_under_way();

/// From now on the calling thread draws beside another that must not wait for long, such as a window's: see
/// end_of_picture(). False: no more.
void let_others_draw(bool on = true);

/// Call after each pass: where the thread lets others draw, it waits until the picture before this one is done.
/// llvmpipe draws pictures of all contexts in the order in which they were handed over, and who hands one over while
/// four wait is held up, whoever they are of, until there is room.
void end_of_picture();

/// Has llvmpipe let go of the images that pictures long done still keep (see keep_few_under_way()): every place is
/// used anew, which takes some ten milliseconds. Call while nothing is asked for. Other drivers have nothing to do.
/// @return false when the machine was so busy that some places may not have been reached
bool let_go_of_done_pictures();

}  // namespace si::gl
