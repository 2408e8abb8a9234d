// Scale of the map viewer's colours, with both ends in metres.
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>

#include "renderer/frame/frame.h"

namespace si {

/// Returns the colour (RGB, 0 to 1) with which the map viewer shows a depth, as in shaders/lib/map_colours.glsl.
/// @param colours grey, Turbo or Viridis @param t place in the shown range of depths, 0 to 1; clamped
glm::vec3 map_ramp_colour(MapColours colours, double t);

/// Draws stripes behind the image in the map viewer. They show through at texels into which nothing was drawn, which
/// are transparent. The width of the stripes does not depend on the zoom.
/// @param lo, hi corners of the image, pixels of the screen @param from, to corners of its visible part
void draw_empty_hatch(ImVec2 lo, ImVec2 hi, ImVec2 from, ImVec2 to);

/// Draws the legend of the map viewer's colours, with the depths at both ends, in the lower right corner of the image.
/// Draws nothing in the view by bands (three ranges of depth) and in small images.
/// @param end lower right corner of the image, pixels of the screen @param size size of the image, pixels
void draw_grey_scale(const ViewSettings& view, const FrameResult& frame, ImVec2 end, ImVec2 size);

}  // namespace si
