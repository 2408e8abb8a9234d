// Scale of the map viewer's colours, with both ends in metres.
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>

#include "renderer/frame/frame.h"

namespace si {

/// Returns a colour of the map viewer's ramp, as shaders/lib/map_colours.glsl does. @param t 0 to 1
glm::vec3 map_ramp_colour(MapColours colours, double t);

/// Draws stripes behind the map's picture, where empty texels are transparent. Their width on the screen does not
/// depend on the zoom. @param lo, hi corners of the picture, pixels @param from, to corners of its visible part
void draw_empty_hatch(ImVec2 lo, ImVec2 hi, ImVec2 from, ImVec2 to);

/// Draws the scale in the lower right corner of the map's picture. Draws nothing for bands and in small pictures.
/// @param end lower right corner of the picture, pixels @param size of the picture, pixels
void draw_grey_scale(const ViewSettings& view, const FrameResult& frame, ImVec2 end, ImVec2 size);

}  // namespace si
